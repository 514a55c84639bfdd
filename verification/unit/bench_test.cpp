// SPDX-License-Identifier: Apache-2.0
// `scree bench`: its output names what was measured.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/cli.hpp"
#include "materials/typical_input.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

std::string output_of(std::vector<const char*> words) {
  words.insert(words.begin(), "scree");
  testing::internal::CaptureStdout();
  const int status = scree_main(static_cast<int>(words.size()), words.data());
  std::fflush(stdout);
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_EQ(status, 0) << out;
  return out;
}

TEST(Bench, MaterialCostsOfEveryLaw) {
  const auto json = nlohmann::json::parse(output_of({"bench", "--material-only", "--json"}));
  const auto& costs = json.at("material_cost");
  EXPECT_EQ(costs.size(), material_registry().size());
  for (const MaterialEntry& entry : material_registry()) {
    for (const char* precision : {"double_ns", "single_ns"}) {
      const double cost = costs.at(entry.name).at(precision).get<double>();
      // At least a tenth of a clock cycle of the fastest core, at most slow even for sanitizers.
      EXPECT_GT(cost, 0.02) << entry.name;
      EXPECT_LT(cost, 1e5) << entry.name;
    }
  }
}

TEST(Bench, MaterialCostsAsText) {
  const std::string text = output_of({"bench", "--material-only"});
  for (const MaterialEntry& entry : material_registry()) {
    EXPECT_NE(text.find("\n" + entry.name + " "), std::string::npos) << text;
  }
}

TEST(Bench, CasesRun) {
  for (const char* name : {"elastic", "sand", "fluid"}) {
    const auto json =
        nlohmann::json::parse(output_of({"bench", "--case", name, "--particles", "512", "--steps",
                                         "2", "--threads", "1", "--json"}));
    EXPECT_EQ(json.at("case"), name);
    EXPECT_GT(json.at("particle_updates_per_second").get<double>(), 0);
  }
}

TEST(TypicalInput, TakesGivenNumbersAndRefusesWrongOnes) {
  for (const MaterialEntry& entry : material_registry()) {
    EXPECT_NO_THROW(typical_input(entry, 2)) << entry.name;
    EXPECT_THROW(typical_input(entry, 3, {{"no_such_key", 1.0}}), UserError) << entry.name;
  }
}

}  // namespace
}  // namespace scree
