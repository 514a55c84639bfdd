// SPDX-License-Identifier: Apache-2.0
// `scree bench --deck`: the steps of a deck; no timings.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/bench_deck.hpp"
#include "solver/base/error.hpp"
#include "verification/unit/run_scree.hpp"

namespace scree {
namespace {

const std::string column = std::string(SCREE_SOURCE_DIR) + "/inputs/tutorial/sand_column_2d.toml";

TEST(BenchDeck, SaysWhatTheDeckIs) {
  std::string out;
  ASSERT_EQ(
      run_scree({"bench", "--deck", column.c_str(), "--set", "method.precision=\"single\"", "--set",
                 "domain.cell_size=0.01", "--steps", "3", "--threads", "1", "--json"},
                out),
      0);
  const auto json = nlohmann::json::parse(out);
  EXPECT_EQ(json["case"], "sand_column_2d");
  EXPECT_EQ(json["dimension"], 2);
  EXPECT_EQ(json["precision"], "single");
  EXPECT_EQ(json["kernel"], "compact");
  EXPECT_EQ(json["particles"], 10 * 20 * 9);  // cells of the column, 9 particles each
  EXPECT_EQ(json["steps"], 3);
}

/// Nothing of the deck's output or end gets in the way of the steps.
TEST(BenchDeck, StepsHaveNoEvents) {
  BenchOptions options;
  options.deck = column;
  const SimulationSetup setup = build_bench_deck(options);
  EXPECT_FALSE(setup.record);
  EXPECT_FALSE(setup.keep_reference);
  EXPECT_FALSE(setup.schedule.finished(1e5));
}

TEST(BenchDeck, MistakesAreUserErrors) {
  BenchOptions options;
  options.deck = column;
  options.overrides = {"domain.cell_size=-1", "method.kernel=\"compct\""};
  std::string text;
  try {
    build_bench_deck(options);
  } catch (const UserError& error) {
    text = error.what();
  }
  EXPECT_NE(text.find("cell_size"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean \"compact\""), std::string::npos) << text;
}

TEST(BenchDeck, ExcludesTheOptionsOfACase) {
  std::string out;
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_scree({"bench", "--deck", column.c_str(), "--kernel", "quadratic"}, out), 2);
  EXPECT_EQ(run_scree({"bench", "--deck", column.c_str(), "--particles", "1000"}, out), 2);
  EXPECT_EQ(run_scree({"bench", "--set", "time.end=1"}, out), 2);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_NE(errors.find("--kernel"), std::string::npos) << errors;
  EXPECT_NE(errors.find("--particles"), std::string::npos) << errors;
}

}  // namespace
}  // namespace scree
