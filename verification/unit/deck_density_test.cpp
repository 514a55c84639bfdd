// SPDX-License-Identifier: Apache-2.0
// The density of a body against what its model knows about it.
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

/// The good deck of grains with another density.
std::string grains(const std::string& density) {
  std::string deck = good_deck;
  const auto replace = [&](const std::string& old, const std::string& text) {
    deck.replace(deck.find(old), old.size(), text);
  };
  replace("\"drucker_prager\"\ndensity = 1600", "\"mu_i\"\ndensity = " + density);
  replace("friction_angle = \"31 deg\"",
          "mu_s = 0.4\nmu_2 = 0.7\ni0 = 0.3\ngrain_diameter = \"1 mm\"\n"
          "grain_density = \"2.5 g/cm^3\"");
  return deck;
}

TEST(DeckDensity, GrainsLeavePores) {
  EXPECT_EQ(problems_of(grains("2499")), "");
  const std::string rest =
      ": leaves no pores between the grains; allowed: below grain_density, 2500.0 kg/m^3; give the "
      "density of the bulk, some 0.6 of that of the grains\n";
  EXPECT_EQ(problems_of(grains("2500")), "deck.toml:16:11: material.sand.density = 2500" + rest);
  EXPECT_EQ(problems_of(grains("\"3 t/m^3\"")),
            "deck.toml:16:11: material.sand.density = \"3 t/m^3\"" + rest);
}

TEST(DeckDensity, OtherMistakesAreReportedAlone) {
  const std::string report = problems_of(grains("3000"), {"material.sand.mu_s=-1"});
  EXPECT_EQ(report.find("pores"), std::string::npos) << report;
  EXPECT_NE(report.find("mu_s"), std::string::npos) << report;
}

}  // namespace
}  // namespace scree::testing_decks
