// SPDX-License-Identifier: Apache-2.0
// The programs for different instruction sets, started through the launcher, compute the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree::testing {
namespace {

using Columns = std::map<std::string, std::vector<double>>;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

Columns read_history(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split(line, ',');
  Columns columns;
  while (std::getline(in, line)) {
    const std::vector<std::string> values = split(line, ',');
    for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) {
      columns[names[i]].push_back(std::strtod(values[i].c_str(), nullptr));
    }
  }
  return columns;
}

ProcessResult scree(const std::string& target, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), SCREE_EXECUTABLE);
  return run_process(arguments, [&] { setenv("SCREE_TARGET", target.c_str(), 1); });
}

/// The targets of this build that this machine can run.
std::vector<std::string> runnable() {
  std::vector<std::string> targets;
  for (const std::string& target : split(SCREE_TARGETS, ',')) {
    if (scree(target, {"info"}).status == 0) targets.push_back(target);
  }
  return targets;
}

/// Columns that hold wall times differ from run to run.
bool is_physical(const std::string& name) { return name.find("wall") == std::string::npos; }

/// The quantity of a column: components of a vector share its size, for one of them may be nothing
/// but rounding.
std::string quantity(const std::string& name) {
  const std::size_t end = name.size() > 2 ? name.size() - 2 : 0;
  const std::string axis = name.substr(end);
  return axis == "_x" || axis == "_y" || axis == "_z" ? name.substr(0, end) : name;
}

void expect_equal(const Columns& a, const Columns& b, double tolerance) {
  std::map<std::string, double> scales;
  for (const auto& [name, values] : a) {
    double& scale = scales[quantity(name)];
    for (const double v : values) scale = std::max(scale, std::abs(v));
  }
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, values] : a) {
    if (!is_physical(name)) continue;
    const std::vector<double>& others = b.at(name);
    ASSERT_EQ(values.size(), others.size()) << name;
    const double scale = scales.at(quantity(name));
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i], others[i], tolerance * scale) << name << ", row " << i;
    }
  }
}

/// Runs a tutorial deck with every target and compares the histories with that of the first.
void compare(const std::string& deck, const std::string& precision, double tolerance) {
  const std::vector<std::string> targets = runnable();
  if (targets.size() < 2) GTEST_SKIP() << "fewer than two programs that run here";
  const TemporaryFolder folder;
  std::optional<Columns> first;
  for (const std::string& target : targets) {
    const std::filesystem::path out = folder.path() / target;
    const ProcessResult run =
        scree(target, {"run", SCREE_SOURCE_DIR "/inputs/tutorial/" + deck, "-o", out.string(),
                       "--max-steps", "60", "--set", "method.precision=\"" + precision + "\"",
                       "--set", "history.every=\"1 ms\""});
    ASSERT_EQ(run.status, 0) << target << ": " << run.err;
    const Columns history = read_history(out / "history.csv");
    ASSERT_GE(history.at("time").size(), 3U);  // a row a millisecond
    if (first) {
      expect_equal(*first, history, tolerance);
    } else {
      first = history;
    }
  }
}

// In 60 steps rounding (fused or separate multiply-add, reciprocals from an approximation) grows to
// some hundred units in the last place of the largest value.
TEST(Targets, AgreeInPlaneStrain) { compare("sand_column_2d.toml", "double", 1e-11); }
TEST(Targets, AgreeInThreeDimensions) { compare("sand_column_3d.toml", "double", 1e-11); }
TEST(Targets, AgreeInSinglePrecision) { compare("sand_column_2d.toml", "single", 1e-3); }

TEST(Targets, AreWhatTheirNamesSay) {
  const std::map<std::string, std::string> instructions{
      {"x86-64-v2", "SSE4.2"}, {"x86-64-v3", "AVX2"}, {"x86-64-v4", "AVX-512"}};
  const std::vector<std::string> targets = runnable();
  if (targets.empty()) GTEST_SKIP() << "no program is built";
  for (const std::string& target : targets) {
    EXPECT_NE(scree(target, {"info"}).out.find(instructions.at(target)), std::string::npos)
        << target;
  }
}

TEST(Targets, AnUnknownOneIsAMistakeOfTheUser) {
  const ProcessResult result = scree("x86-64-v9", {"info"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("SCREE_TARGET=x86-64-v9: unknown; allowed: x86-64-v4"),
            std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace scree::testing
