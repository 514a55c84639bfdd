// SPDX-License-Identifier: Apache-2.0
// `scree element`: files, pictures and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/element_command.hpp"
#include "solver/base/error.hpp"
#include "solver/element/yield_locus.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

const char* const deck_text = R"([material.sand]
model = "drucker_prager"
density = 1600
youngs_modulus = "10 MPa"
poissons_ratio = 0.2
friction_angle = "30 deg"
[path]
type = "triaxial_drained"
confining_pressure = "100 kPa"
strain = 0.05
steps = 50
)";

class ElementCommand : public testing::Test {
 protected:
  ElementCommand() {
    write_text(folder / "sand.toml", deck_text);
    options.deck = (folder / "sand.toml").string();
    options.output = (folder / "sand.csv").string();
    options.quiet = true;
  }
  /// The sentence of the mistake, or the exit status.
  std::string run() {
    try {
      return "status " + std::to_string(element_command(options));
    } catch (const UserError& error) {
      return error.what();
    }
  }

  TemporaryFolder folder;
  ElementOptions options;
};

TEST_F(ElementCommand, WritesTableAndPicture) {
  options.plot = (folder / "sand.png").string();
  EXPECT_EQ(run(), "status 0");
  const std::string csv = read_text(folder / "sand.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 52);
  const std::string png = read_text(folder / "sand.png");
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_GT(png.size(), 20000u);
  // Both are the driver's own: a second call replaces them.
  options.overrides = {"path.steps=10"};
  EXPECT_EQ(run(), "status 0");
  const std::string again = read_text(folder / "sand.csv");
  EXPECT_EQ(std::count(again.begin(), again.end(), '\n'), 12);
  EXPECT_NE(read_text(folder / "sand.png"), png);
}

TEST_F(ElementCommand, RefusesToReplaceOtherFiles) {
  write_text(folder / "notes.txt", "mine\n");
  const std::string notes = (folder / "notes.txt").string();
  const std::string refusal = notes +
                              " exists and was not written by scree element; name another file, "
                              "or add --overwrite";
  options.output = notes;
  EXPECT_EQ(run(), refusal);
  options.output = (folder / "sand.csv").string();
  options.plot = notes;
  EXPECT_EQ(run(), refusal);
  EXPECT_EQ(read_text(folder / "notes.txt"), "mine\n");
  EXPECT_FALSE(fs::exists(folder / "sand.csv"));
  options.overwrite = true;
  EXPECT_EQ(run(), "status 0");
}

TEST_F(ElementCommand, RefusesPlacesThatCannotBeWritten) {
  options.output = folder.path().string();
  EXPECT_EQ(run(), folder.path().string() + " is a folder; name a file");
  options.output = (folder / "none/a.csv").string();
  EXPECT_EQ(run(), "there is no folder " + (folder / "none").string() + " to write a.csv into");
  options.output = options.plot = (folder / "same").string();
  EXPECT_EQ(run(), "-o and --plot name the same file, " + (folder / "same").string());
}

TEST_F(ElementCommand, AFaultyDeckEndsWith2AndWritesNothing) {
  options.overrides = {"path.type=\"triaxial\"", "path.steps=0"};
  testing::internal::CaptureStderr();
  EXPECT_EQ(run(), "status 2");
  const std::string report = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(report.begin(), report.end(), '\n'), 2) << report;
  EXPECT_FALSE(fs::exists(folder / "sand.csv"));
}

TEST(YieldLocus, IsTheConeOfSand) {
  Problems problems;
  const ElementDeck deck = read_element_text(deck_text, "sand.toml", {}, problems);
  ASSERT_TRUE(problems.empty()) << problems.text();
  const ElementResult result = drive_element(deck);
  const double last = result.rows.back().pressure();
  const auto locus = yield_locus(result, triaxial_compression, {0, 1.15 * last});
  if (!result.rows.back().yield_value) GTEST_SKIP() << "the law tells no yield function";
  ASSERT_GT(locus.size(), 20u);
  for (const auto& [p, q] : locus) {
    // M = 1.2 for 30 degrees; the point counts as yielding 1e-7 of the law's scale before.
    EXPECT_NEAR(q, 1.2 * p, 1e-4 * 167e3) << p;
  }
  EXPECT_GT(locus.back().first, 1.1 * last);
}

}  // namespace
}  // namespace scree
