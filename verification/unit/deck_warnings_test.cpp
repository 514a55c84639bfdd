// SPDX-License-Identifier: Apache-2.0
// What a deck may say but hardly means, and how check says it.
#include "app/deck_warnings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "app/build_simulation.hpp"
#include "app/check_command.hpp"
#include "materials/registry.hpp"
#include "solver/particles/shape_volume.hpp"
#include "verification/support/temporary_folder.hpp"
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

using Texts = std::vector<std::string>;

/// Warnings of the good deck in cells of 2 cm, with another text in place of its line 25.
Texts warnings_of(const std::string& addition, const Texts& overrides = {}) {
  Texts all{"domain.cell_size=0.02", "domain.upper=[0.8, 0.4]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Problems problems;
  const Deck deck = read_deck_text(with_line(25, addition), "deck.toml", all, problems);
  EXPECT_EQ(problems.text(), "");
  return deck_warnings(deck, build_setup(deck));
}

TEST(DeckWarnings, TheGoodDeckHasNone) { EXPECT_EQ(warnings_of(""), Texts()); }

TEST(DeckWarnings, TheLinearKernel) {
  const Texts warnings = warnings_of("", {"method.kernel=\"linear\"", "method.transfer=\"pic\""});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("method.kernel = \"linear\" is there for comparison"),
            std::string::npos);
}

constexpr const char* drop = R"([domain]
dimension = 3
lower = [0.0, 0.0, 0.0]
upper = [0.4, 0.4, 0.4]
cell_size = 0.1
[time]
end = 0.001
[material.water]
model = "newtonian"
density = 1000
bulk_modulus = 1e5
[body.drop]
material = "water"
shape = { type = "box", lower = [0.1, 0.1, 0.1], upper = [0.3, 0.3, 0.3] }
)";

/// 0.71 of sqrt(4/tr D^-1), tr D^-1 = 30.5 in 3D (docs/method.md, section 3).
TEST(DeckWarnings, ACourantNumberThatFluidsDoNotTake) {
  const auto warnings = [](const Texts& overrides) {
    Problems problems;
    const Deck deck = read_deck_text(drop, "drop.toml", overrides, problems);
    EXPECT_EQ(problems.text(), "");
    return deck_warnings(deck, build_setup(deck));
  };
  EXPECT_EQ(warnings({"time.cfl=0.45"}),
            Texts{"time.cfl = 0.45: with fluids it counts as 0.257, or drops would come apart"});
  EXPECT_EQ(warnings({"time.cfl=0.4"}), Texts());
  EXPECT_EQ(warnings({"time.step=1e-4"}), Texts());
}

constexpr const char* clay = R"([domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.4, 0.4]
cell_size = 0.1
[time]
end = 0.001
[method]
volumetric_locking = "fbar"
gravity = [0.0, -10.0]
[material.clay]
model = "modified_cam_clay"
density = 1800
m = 1.0
lambda = 0.2
kappa = 0.04
poissons_ratio = 0.3
reference_void_ratio = 2
initial_pressure = 1e5
[body.ground]
material = "clay"
shape = { type = "box", lower = [0.0, 0.0], upper = [0.4, 0.2] }
[body.hill]
material = "clay"
shape = { type = "box", lower = [0.0, 0.2], upper = [0.4, 0.4] }
)";

TEST(DeckWarnings, AveragesOfClayThatDilates) {
  if (find_material_model("modified_cam_clay") == nullptr) GTEST_SKIP() << "left out of this build";
  const auto warnings = [](const Texts& overrides) {
    Problems problems;
    const Deck deck = read_deck_text(clay, "clay.toml", overrides, problems);
    EXPECT_EQ(problems.text(), "");
    return deck_warnings(deck, build_setup(deck));
  };
  const Texts four{
      "method.volumetric_locking = \"fbar\" averages all changes of volume of modified_cam_clay: "
      "the material clay is overconsolidated 4 times, and above 2 clay dilates; leave it off"};
  EXPECT_EQ(warnings({"material.clay.ocr=4"}), four);  // once for both bodies
  EXPECT_EQ(warnings({"material.clay.ocr=4", "method.volumetric_locking=\"none\""}), Texts());
  EXPECT_EQ(warnings({"material.clay.ocr=2"}), Texts());
  EXPECT_EQ(warnings({"material.clay.preconsolidation_pressure=4e5"}), four);
  EXPECT_EQ(warnings({"material.clay.preconsolidation_pressure=2e5"}), Texts());
  // Under an initial stress ocr holds at every place, and a preconsolidation_pressure does not
  // tell.
  const auto stressed = [&](const std::string& key) {
    const std::string stress = "{ type = \"uniform\", value = [-1e5, -1e5, -1e5] }";
    return warnings(
        {key, "body.ground.initial_stress=" + stress, "body.hill.initial_stress=" + stress});
  };
  EXPECT_EQ(stressed("material.clay.ocr=4"), four);
  EXPECT_EQ(stressed("material.clay.preconsolidation_pressure=4e5"), Texts());
}

TEST(Check, SaysWhichCourantNumberFluidsTake) {
  const TemporaryFolder folder;
  CheckOptions options;
  options.deck = (folder / "drop.toml").string();
  options.threads = 1;
  std::ofstream(options.deck) << drop;
  testing::internal::CaptureStdout();
  EXPECT_EQ(check_command(options), 0);
  std::fflush(stdout);
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_NE(out.find("s (cfl 0.257 in place of 0.4, or drops of fluid would come apart)"),
            std::string::npos)
      << out;
}

TEST(DeckWarnings, BodiesThatOverlap) {
  // Particles are 2/3 cm apart: in 2 cm x 4 cm lie 3 x 6.
  EXPECT_EQ(warnings_of(R"([body.two]
material = "sand"
shape = { type = "box", lower = [0.08, 0.16], upper = [0.16, 0.24] })"),
            Texts{"the bodies column and two overlap: 18 particles of two in column, where mass "
                  "counts twice"});
  // None of the coarse body's particles, 10 cm apart, lies in the small one.
  EXPECT_EQ(warnings_of(R"([body.two]
material = "sand"
particles_per_direction = 1
shape = { type = "box", lower = [0.0, 0.0], upper = [0.02, 0.02] })",
                        {"body.two.shape.lower=[0.02, 0.02]", "body.two.shape.upper=[0.04, 0.04]"}),
            Texts{"the bodies column and two overlap: 1 particle of two in column, where mass "
                  "counts twice"});
}

TEST(DeckWarnings, ColliderBeyondAPeriodicFace) {
  // 2 cm of the plate come in at x = 0: 3 x 6 particles.
  EXPECT_EQ(warnings_of(R"([collider.plate]
contact = "slip"
shape = { type = "box", lower = [0.78, 0.04], upper = [0.82, 0.08] })",
                        {"boundary.x_min=\"periodic\"", "boundary.x_max=\"periodic\""}),
            Texts{"the collider plate holds 18 particles of the body column at t = 0"});
}

TEST(DeckWarnings, BodiesThatShareAFaceDoNotOverlap) {
  EXPECT_EQ(warnings_of(R"([body.two]
material = "sand"
shape = { type = "box", lower = [0.1, 0.0], upper = [0.2, 0.2] })"),
            Texts());
}

TEST(DeckWarnings, CollidersInABody) {
  EXPECT_EQ(warnings_of(R"([collider.plate]
shape = { type = "box", lower = [0.08, 0.16], upper = [0.2, 0.3] }
contact = "slip")"),
            Texts{"the collider plate holds 18 particles of the body column at t = 0"});
  EXPECT_EQ(warnings_of(R"([collider.plate]
shape = { type = "plane", point = [0, 0.2], normal = [0, -1] }
contact = "slip")"),
            Texts());
}

TEST(DeckWarnings, ParticlesThatMissTheMassOfTheirShape) {
  // Cells of 20 cm with one particle each: the box of 0.1 m x 0.2 m gets one, of 0.04 m^2.
  EXPECT_EQ(warnings_of("", {"domain.cell_size=0.2", "body.column.particles_per_direction=1",
                             "body.column.shape.upper=[0.15, 0.2]"}),
            Texts{"the particles of the body column have 64 kg/m, but its shape 48 kg/m; lower "
                  "domain.cell_size or raise particles_per_direction"});
}

TEST(DeckWarnings, MassesWithTheirShapes) {
  Problems problems;
  const Deck deck = read_deck_text(good_deck, "deck.toml", {}, problems);
  // 0.1 m x 0.2 m of 1600 kg/m^3; the box is a whole number of cells.
  EXPECT_EQ(masses_text(deck, build_setup(deck)), "column 32 kg/m (shape 32)");
}

TEST(Check, ADeckWhoseFirstStepsFailIsNotValid) {
  const TemporaryFolder folder;
  CheckOptions options;
  options.deck = (folder / "fast.toml").string();
  options.threads = 1;
  // In a step of 0.1 s gravity alone moves particles by 9.81 cm, that is 20 cells.
  std::ofstream(options.deck) << with_line(9, "step = 0.1");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = check_command(options);
  std::fflush(stdout);
  const std::string out = testing::internal::GetCapturedStdout();
  const std::string error = testing::internal::GetCapturedStderr();
  EXPECT_EQ(status, 1);
  EXPECT_EQ(out.find("valid"), std::string::npos) << out;
  EXPECT_EQ(error.rfind("scree: " + options.deck + ": the first steps fail: ", 0), 0u) << error;
}

TEST(Check, PrintsMassesAndWarningsAndNoEndlessNumbers) {
  const TemporaryFolder folder;
  CheckOptions options;
  options.deck = (folder / "long.toml").string();
  options.threads = 1;
  options.overrides = {"domain.cell_size=0.02", "domain.upper=[0.8, 0.4]", "time.end=1e300"};
  std::ofstream(options.deck) << with_line(25, R"([collider.plate]
shape = { type = "box", lower = [0.08, 0.16], upper = [0.2, 0.3] }
contact = "separate")");
  testing::internal::CaptureStdout();
  EXPECT_EQ(check_command(options), 0);
  std::fflush(stdout);
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_NE(out.find("mass             column 32 kg/m (shape 32)\n"), std::string::npos) << out;
  EXPECT_NE(out.find("warning          the collider plate holds 18 particles"), std::string::npos)
      << out;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) EXPECT_LT(line.size(), 120u) << line;
}

TEST(ShapeVolume, IsThatOfTheFormula) {
  ShapeSpec s;
  s.kind = ShapeKind::box;
  s.lower = {1, 2, 3};
  s.upper = {2, 4, 6};
  EXPECT_EQ(exact_volume(s, 3), 6);  // 1 x 2 x 3
  EXPECT_EQ(exact_volume(s, 2), 2);
  s.radius = 0.5;
  s.to = {3, 4, 12};  // 13 m from the origin, 5 m in the plane
  constexpr double pi = std::numbers::pi;
  const double rounding = 1e-14;  // a few operations on numbers of about 10
  s.kind = ShapeKind::sphere;
  EXPECT_NEAR(*exact_volume(s, 3), 4 * pi / 3 / 8, rounding);
  EXPECT_NEAR(*exact_volume(s, 2), pi / 4, rounding);
  s.kind = ShapeKind::cylinder;
  EXPECT_NEAR(*exact_volume(s, 3), 13 * pi / 4, rounding);
  EXPECT_NEAR(*exact_volume(s, 2), 5, rounding);  // a strip of width 1 m
  s.kind = ShapeKind::polygon;
  s.points = {{0, 0}, {0, 3}, {4, 0}};
  s.z = {1, 3, 0};
  EXPECT_NEAR(*exact_volume(s, 2), 6, rounding);
  EXPECT_NEAR(*exact_volume(s, 3), 12, rounding);
  s.kind = ShapeKind::union_of;
  EXPECT_FALSE(exact_volume(s, 3));
}

}  // namespace
}  // namespace scree::testing_decks
