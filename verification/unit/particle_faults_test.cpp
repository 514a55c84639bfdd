// SPDX-License-Identifier: Apache-2.0
// Mistakes that only the building of a simulation can see: reading does not sample large bodies.
#include "solver/deck/particle_faults.hpp"

#include <gtest/gtest.h>

#include "app/build_simulation.hpp"
#include "solver/base/error.hpp"
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

/// What building the good deck with another line 22 says; the deck itself must be right.
std::string refusal(const std::string& line, const std::vector<std::string>& overrides = {}) {
  Problems problems;
  const Deck deck = read_deck_text(with_line(22, line), "deck.toml", overrides, problems);
  EXPECT_EQ(problems.text(), "");
  try {
    build_setup(deck);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

const std::vector<std::string> fine{"domain.cell_size=0.0005"};

/// Its bounds hold 1680 x 1680 sites a sixth of a millimetre apart, more than reading samples.
constexpr const char* strip =
    "shape = { type = \"cylinder\", from = [0.01, 0.01], to = [0.29, 0.29], radius = 0.0005 }\n";

TEST(ParticleFaults, OfLargeBodiesStopTheBuild) {
  EXPECT_EQ(
      refusal(strip + std::string("velocity = [0, \"log(0.1 - y)\"]"), fine)
          .rfind("body.column.velocity: \"log(0.1 - y)\" is not finite at the particle at [", 0),
      0u);
  EXPECT_EQ(refusal(strip + std::string("velocity = [0, \"log(1 + y)\"]"), fine), "");
  EXPECT_EQ(refusal(strip + std::string(R"([traction.t]
body = "column"
region = { type = "box", lower = [0.6, 0], upper = [0.7, 0.1] }
pressure = 1)"),
                    fine)
                .rfind("traction.t.region: holds no face of the body's surface", 0),
            0u);
}

TEST(ParticleFaults, VelocityMustBeANumberBesideParticlesToo) {
  // The first particle is at 5/6 mm; its gradient looks 5 and 10 micrometres to both sides.
  EXPECT_EQ(
      refusal("shape = { type = \"box\", lower = [0, 0], upper = [0.1, 0.2] }\n"
              "velocity = [0, \"sqrt(x - 0.00083)\"]"),
      "body.column.velocity: \"sqrt(x - 0.00083)\" is not finite beside the particle at "
      "[0.000833333333, 0.000833333333] m; the velocity gradient needs it within 0.002 cells");
}

}  // namespace
}  // namespace scree::testing_decks
