// SPDX-License-Identifier: Apache-2.0
// Every deck of inputs/element is right, runs, and gives a whole table and a picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/element_command.hpp"
#include "materials/registry.hpp"
#include "solver/element/element_test.hpp"
#include "verification/support/example_decks.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

/// The law that a deck's name begins with, or null where this build lacks it.
const MaterialEntry* law_of(const fs::path& deck) {
  for (const MaterialEntry& law : material_registry()) {
    if (deck.stem().string().rfind(law.name + "_", 0) == 0) return &law;
  }
  return nullptr;
}

TEST(ElementDecks, EveryLawHasOne) {
  std::set<std::string> driven;
  for (const fs::path& deck : testing::decks_below("element")) {
    if (const MaterialEntry* law = law_of(deck)) driven.insert(law->name);
  }
  for (const MaterialEntry& law : material_registry()) {
    EXPECT_TRUE(driven.contains(law.name)) << law.name << " has no deck in inputs/element";
  }
}

TEST(ElementDecks, EveryDeckRunsToItsEnd) {
  const TemporaryFolder folder;
  for (const fs::path& deck : testing::decks_below("element")) {
    if (law_of(deck) == nullptr) continue;
    SCOPED_TRACE(deck.filename());
    ElementOptions options;
    options.deck = deck.string();
    options.output = (folder / (deck.stem().string() + ".csv")).string();
    options.plot = (folder / (deck.stem().string() + ".png")).string();
    options.quiet = true;
    ASSERT_EQ(element_command(options), 0);
    const std::string table = read_text(options.output);
    EXPECT_EQ(table.find("nan"), std::string::npos);
    EXPECT_EQ(table.find("inf"), std::string::npos);
    EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 100);
    EXPECT_GT(fs::file_size(options.plot), 10000u);
  }
}

TEST(ElementDecks, StatesStayInsideTheYieldSurface) {
  for (const fs::path& path : testing::decks_below("element")) {
    if (law_of(path) == nullptr) continue;
    SCOPED_TRACE(path.filename());
    Problems problems;
    const ElementDeck deck = read_element_deck(path.string(), {}, problems);
    ASSERT_TRUE(problems.empty()) << problems.text();
    for (const ElementRow& row : drive_element(deck).rows) {
      // The function is dimensionless; return maps end on the surface to rounding.
      EXPECT_LE(row.yield_value.value_or(0), 1e-8) << row.step;
    }
  }
}

}  // namespace
}  // namespace scree
