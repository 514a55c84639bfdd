// SPDX-License-Identifier: Apache-2.0
// Decks with initial stress and pore water: what is refused, with which sentence, and what a run
// gets.
#include <algorithm>
#include <cmath>

#include "app/build_simulation.hpp"
#include "solver/deck/initial_stress.hpp"
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

/// The good deck whose body has this initial stress; other lines as --set.
std::string stressed(const std::string& stress) {
  return with_line(22,
                   "shape = { type = \"box\", lower = [0.0, 0.0], upper = [0.1, 0.2] }\n"
                   "initial_stress = " +
                       stress);
}

std::string report_of(const std::string& stress, const std::vector<std::string>& set = {}) {
  return problems_of(stressed(stress), set);
}

const char* const at_rest = R"~({ type = "geostatic", surface = 0.2 })~";

TEST(DeckInitialStress, GeostaticNeedsNoMoreThanItsSurface) { EXPECT_EQ(report_of(at_rest), ""); }

TEST(DeckInitialStress, ValueHasThreeEntries) {
  EXPECT_EQ(report_of(R"~({ type = "uniform", value = [0, 0] })~"),
            "deck.toml:23:46: body.column.initial_stress.value = [0, 0]: has 2 entries; allowed: 3 "
            "numbers\n");
}

TEST(DeckInitialStress, ParticlesAboveTheSurface) {
  EXPECT_EQ(report_of(R"~({ type = "geostatic", surface = 0.15, k0 = 0.5 })~"),
            "deck.toml:23:50: body.column.initial_stress.surface = 0.15: a particle lies 0.04917 m "
            "above it; move the surface to the top of the body, or cut the body there\n");
}

TEST(DeckInitialStress, GravityAlongAnAxisAtTheStart) {
  const std::string expected =
      "deck.toml:23:18: body.column.initial_stress = { type = \"geostatic\", surface = 0.2 }: "
      "geostatic stress needs a method.gravity that is along one axis at t = 0; set "
      "method.gravity, or use type = \"uniform\"\n";
  EXPECT_EQ(report_of(at_rest, {"method.gravity=[1, -9.81]"}), expected);
  EXPECT_EQ(report_of(at_rest, {"method.gravity=[0, 0]"}), expected);
  EXPECT_EQ(report_of(at_rest, {"method.gravity=[0, \"-9.81*t\"]"}), expected);
  EXPECT_EQ(report_of(at_rest, {"method.gravity=[\"sin(t)\", \"-9.81*cos(t)\"]"}), "");
}

TEST(DeckInitialStress, OutsideTheYieldSurfaceNamesWhatIsInside) {
  // Plane strain match, psi = 0: M = sqrt(3) sin phi; K0 from q = M p: (1 - k) 3 = M (1 + 2 k).
  const double M = std::sqrt(3) * std::sin(31 * std::acos(-1) / 180);
  const double lowest = (3 - M) / (3 + 2 * M), highest = (3 + M) / (3 - 2 * M);
  const std::string report = report_of(R"~({ type = "geostatic", surface = 0.2, k0 = 0.2 })~");
  EXPECT_EQ(report.rfind("deck.toml:23:18: body.column.initial_stress = ", 0), 0u) << report;
  EXPECT_NE(report.find("model drucker_prager has no elastic state with the stress"),
            std::string::npos)
      << report;
  const std::string phrase = "allowed: k0 of ";
  const std::size_t at = report.find(phrase);
  ASSERT_NE(at, std::string::npos) << report;
  double low = 0, high = 0;
  ASSERT_EQ(std::sscanf(report.c_str() + at + phrase.size(), "%lf to %lf", &low, &high), 2);
  EXPECT_NEAR(low / lowest, 1, 2e-3);  // printed with four digits, searched to 1e-4
  EXPECT_NEAR(high / highest, 1, 2e-3);
  EXPECT_EQ(report_of(R"~({ type = "geostatic", surface = 0.2, k0 = )~" +
                      std::to_string(low * 1.01) + " }"),
            "");
}

/// The good deck of clay that is `depth` deep; the line after the pressure says what pc is.
std::string clay_deck(const std::string& consolidation) {
  std::string deck = stressed(at_rest);
  const std::string sand =
      "model = \"drucker_prager\"\ndensity = 1600\nyoungs_modulus = \"2 MPa\"\n"
      "poissons_ratio = 0.3\nfriction_angle = \"31 deg\"\n";
  const std::string clay =
      "model = \"modified_cam_clay\"\ndensity = 1600\nm = 1\nlambda = 0.1\nkappa = 0.02\n"
      "poissons_ratio = 0.3\nreference_void_ratio = 1.5\ninitial_pressure = 500\n" +
      consolidation + "\n";
  return deck.replace(deck.find(sand), sand.size(), clay);
}

/// pc follows the weight, so the same keys serve all depths; a given pc does not.
TEST(DeckInitialStress, NormallyConsolidatedClayOfAnyDepth) {
  for (const char* gravity : {"-9.81", "-9810"}) {
    const std::vector<std::string> set{"method.gravity=[0, " + std::string(gravity) + "]"};
    EXPECT_EQ(problems_of(clay_deck("ocr = 1"), set), "");
  }
  EXPECT_EQ(problems_of(clay_deck("preconsolidation_pressure = 4e3")), "");
  const std::string report = problems_of(clay_deck("preconsolidation_pressure = 600"));
  EXPECT_NE(report.find("; raise preconsolidation_pressure, or give ocr, which holds at every "
                        "depth\n"),
            std::string::npos)
      << report;
}

TEST(DeckInitialStress, ClayWithoutVoidsIsToldWhatHelps) {
  const std::string report =
      problems_of(clay_deck("ocr = 1"), {"material.sand.reference_void_ratio=0.1"});
  EXPECT_NE(report.find("; raise reference_void_ratio, for no voids would be left\n"),
            std::string::npos)
      << report;
}

TEST(DeckInitialStress, RunsOfClayGetTheirOcrAtEveryParticle) {
  Problems problems;
  const Deck deck = read_deck_text(clay_deck("ocr = 1.5"), "deck.toml", {}, problems);
  ASSERT_TRUE(problems.empty()) << problems.text();
  const auto simulation = Simulation::create(build_setup(deck));
  const auto snapshot = simulation->particles({"stress", "log_preconsolidation"});
  // eta (1 + nu)(1 - L)/(3 (1 - 2 nu)) + 3 eta L/(M^2 - eta^2) = 1 with L = 0.8, M = 1, nu = 0.3
  const double eta = [] {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double x = 0.5 * (low + high);
      (x * 0.26 / 1.2 + 2.4 * x / (1 - x * x) < 1 ? low : high) = x;
    }
    return low;
  }();
  const double rest = (3 - eta) / (3 + 2 * eta);
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    const double vertical = 1600 * 9.81 * (0.2 - snapshot.position[3 * p + 1]);
    const double mean = vertical * (1 + 2 * rest) / 3;
    const double* stress = &snapshot.fields[0].values[9 * p];
    EXPECT_NEAR(stress[4], -vertical, 1e-11 * vertical);  // logarithms of 1e-16 over kappa
    EXPECT_NEAR(stress[0], -rest * vertical, 1e-11 * vertical);
    EXPECT_NEAR(stress[8], -rest * vertical, 1e-11 * vertical);
    const double pc = 1.5 * mean * (1 + eta * eta);  // the keys': 1.5 * 500
    EXPECT_NEAR(snapshot.fields[1].values[p], std::log(pc / 750), 1e-12);
  }
}

TEST(DeckInitialStress, SandCarriesNoTension) {
  const std::string report = report_of(R"~({ type = "uniform", value = [100, 100, 100] })~");
  EXPECT_EQ(
      report,
      "deck.toml:23:46: body.column.initial_stress.value = [100, 100, 100]: model "
      "drucker_prager has no elastic state with the stress [100, 100, 100] Pa; allowed: "
      "stresses inside the yield surface, of a kind that the law carries; change the stress, or "
      "change the strength of the material\n");
  EXPECT_EQ(report_of(R"~({ type = "uniform", value = [100, 100, 100] })~",
                      {"material.sand.cohesion=\"1 kPa\""}),
            "");
}

TEST(DeckInitialStress, AllProblemsAtOnce) {
  const std::string report =
      report_of(R"~({ type = "geostatic", surface = 0.1 })~",
                {"boundary.x_min=\"slippery\"", "output.fields=[\"stres\"]"});
  EXPECT_NE(report.find("above it"), std::string::npos) << report;
  EXPECT_NE(report.find("boundary.x_min"), std::string::npos) << report;
  EXPECT_NE(report.find("did you mean \"stress\"?"), std::string::npos) << report;
}

TEST(DeckInitialStress, RunsGetTheWeightAboveEveryParticle) {
  Problems problems;
  const Deck deck = read_deck_text(stressed(at_rest), "deck.toml", {}, problems);
  ASSERT_TRUE(problems.empty()) << problems.text();
  const auto simulation = Simulation::create(build_setup(deck));
  const auto snapshot = simulation->particles({"stress"});
  const double rest = 1 - std::sin(31 * std::acos(-1) / 180);  // the model's k0
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    const double vertical = -1600 * 9.81 * (0.2 - snapshot.position[3 * p + 1]);
    const double* stress = &snapshot.fields[0].values[9 * p];
    const double rounding = 1e-15 * 2e6;  // of the stretch, times the stiffness, some roundings
    EXPECT_NEAR(stress[4], vertical, 1e-12 * 3200 + 4 * rounding);
    EXPECT_NEAR(stress[0], rest * vertical, 1e-12 * 3200 + 4 * rounding);
    EXPECT_NEAR(stress[8], rest * vertical, 1e-12 * 3200 + 4 * rounding);
  }
}

TEST(DeckInitialStress, GravityMayPointUpOrAside) {
  Problems problems;
  const Deck deck =
      read_deck_text(stressed(R"~({ type = "geostatic", surface = -0.1, k0 = 0.7 })~"), "deck.toml",
                     {"method.gravity=[5, 0]"}, problems);
  ASSERT_TRUE(problems.empty()) << problems.text();
  const InitialStress field(deck, deck.bodies[0], deck.materials[0]);
  const double x[3] = {0.05, 0.1, 0};
  EXPECT_EQ(field.axis(), 0);
  EXPECT_NEAR(field.at(x)[0], -1600 * 5 * 0.15, 1e-9);
  EXPECT_NEAR(field.at(x)[1], -0.7 * 1600 * 5 * 0.15, 1e-9);
}

/// Lets water flow in the good deck; more lines for --set.
std::vector<std::string> with_water(const std::vector<std::string>& more) {
  std::vector<std::string> set{"coupling.type=\"biot\"", "material.sand.porosity=0.4",
                               "material.sand.hydraulic_conductivity=1e-5"};
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

const char* const total_stress =
    R"~({ type = "uniform", value = [-5e3, -5e3, -6e3], total = true })~";

TEST(DeckTotalStress, EffectiveIsThatAndThePressure) {
  Problems problems;
  const Deck deck = read_deck_text(stressed(total_stress), "deck.toml",
                                   with_water({"material.sand.biot_coefficient=0.8",
                                               "coupling.initial_pressure=\"2e3 + 1e4*x\""}),
                                   problems);
  ASSERT_TRUE(problems.empty()) << problems.text();
  const InitialStress field(deck, deck.bodies[0], deck.materials[0]);
  const double x[3] = {0.05, 0.1, 0};
  EXPECT_NEAR(field.at(x)[0], -5e3 + 0.8 * 2.5e3, 1e-9);
  EXPECT_NEAR(field.at(x)[1], -5e3 + 0.8 * 2.5e3, 1e-9);
  EXPECT_NEAR(field.at(x)[2], -6e3 + 0.8 * 2.5e3, 1e-9);
  EXPECT_NE(resolved_toml(deck).find("total = true"), std::string::npos);
}

/// The fields of a run at its start, at every particle, under a water table inside the body.
TEST(DeckTotalStress, RunsStartWithIt) {
  const std::vector<std::string> set = with_water(
      {"domain.cell_size=0.02", "material.sand.biot_coefficient=0.8", "coupling.water_table=0.15"});
  Problems problems;
  const Deck deck = read_deck_text(stressed(total_stress), "deck.toml", set, problems);
  ASSERT_TRUE(problems.empty()) << problems.text();
  const auto simulation = Simulation::create(build_setup(deck));
  const auto snapshot = simulation->particles({"stress", "effective_stress", "pore_pressure"});
  const double rounding = 1e-12 * 6e3 + 4 * 1e-15 * 2e6;  // of the stretch, times the stiffness
  double highest = 0;
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    const double pressure = 9810 * std::max(0.0, 0.15 - snapshot.position[3 * p + 1]);
    highest = std::max(highest, pressure);
    EXPECT_NEAR(snapshot.fields[2].values[p], pressure, 1e-12 * 1500);
    for (std::size_t k = 0; k < 9; ++k) {
      const double total = k == 8 ? -6e3 : k % 4 == 0 ? -5e3 : 0;
      const double effective = total + (k % 4 == 0 ? 0.8 * pressure : 0);
      EXPECT_NEAR(snapshot.fields[0].values[9 * p + k], total, rounding);
      EXPECT_NEAR(snapshot.fields[1].values[9 * p + k], effective, rounding);
    }
  }
  EXPECT_GT(highest, 1e3);
}

/// Where the pressure is highest there is tension; a particle anywhere may be the one.
TEST(DeckTotalStress, IsTriedWhereThePressureIsHighest) {
  for (const char* pressure : {"2e3 + 6e4*x", "2e3 + 3e4*y", "8e3 - 6e4*x"}) {
    const std::string report = report_of(
        total_stress, with_water({std::string("coupling.initial_pressure=\"") + pressure + "\""}));
    EXPECT_EQ(report.rfind("deck.toml:23:46: body.column.initial_stress.value = [-5e3, -5e3, "
                           "-6e3]: model drucker_prager has no elastic state with the effective "
                           "stress [",
                           0),
              0u)
        << report;
  }
  EXPECT_EQ(report_of(total_stress, with_water({"coupling.initial_pressure=\"1e3 + 2e4*x\""})), "");
  EXPECT_EQ(report_of(total_stress, with_water({"coupling.water_table=0.2"})), "");
}

TEST(DeckTotalStress, NeedsWaterThatFlows) {
  const std::string place = "deck.toml:23:74: body.column.initial_stress.total = true: ";
  const std::string dry = place +
                          "no water flows in material sand, so that total and effective stress "
                          "are the same; remove it, or set the porosity of the material";
  EXPECT_EQ(report_of(total_stress), dry + " and add [coupling]\n");
  EXPECT_NE(report_of(total_stress, {"coupling.type=\"biot\""}).find(dry + "\n"),
            std::string::npos);
  EXPECT_EQ(report_of(total_stress, {"material.sand.undrained_bulk_modulus=1e8"}),
            place +
                "the pore pressure of undrained_bulk_modulus starts from zero, so that total and "
                "effective stress are the same; remove it\n");
  EXPECT_EQ(report_of(R"~({ type = "uniform", value = [-5e3, -5e3, -6e3], total = false })~"), "");
}

/// What is wrong elsewhere is said once, and not a second time as a stress.
TEST(DeckTotalStress, FaultsOfTheWaterAreSaidOnce) {
  const std::string report =
      report_of(total_stress, with_water({"coupling.initial_pressure=\"1e3/(x-x)\""}));
  EXPECT_NE(report.find("is not finite at the particle at"), std::string::npos) << report;
  EXPECT_EQ(std::count(report.begin(), report.end(), '\n'), 1) << report;
  const std::string dry = report_of(total_stress, {"material.sand.porosity=0.4"});
  EXPECT_EQ(dry.find("total"), std::string::npos) << dry;
}

TEST(DeckTotalStress, BelongsToUniformStress) {
  const std::string report =
      report_of(R"~({ type = "geostatic", surface = 0.2, total = true })~", with_water({}));
  EXPECT_NE(report.find("total = true: does not belong to type = \"geostatic\""), std::string::npos)
      << report;
  EXPECT_EQ(std::count(report.begin(), report.end(), '\n'), 1) << report;
}

TEST(DeckPoreWater, FluidsCannotHaveIt) {
  const std::string fluid =
      "model = \"j_fluid\"\nbulk_modulus = 1e6\ngamma = 7\ndensity = 1000\n"
      "undrained_bulk_modulus = 1e6";
  std::string deck = with_line(15, fluid);
  for (const char* line : {"density = 1600\n", "youngs_modulus = \"2 MPa\"\n",
                           "poissons_ratio = 0.3\n", "friction_angle = \"31 deg\"\n"}) {
    deck.erase(deck.find(line), std::string(line).size());
  }
  const std::string report = problems_of(deck);
  EXPECT_EQ(
      report.rfind("deck.toml:19:26: material.sand.undrained_bulk_modulus = 1e6: does not "
                   "belong to model = \"j_fluid\"; allowed: model, density; remove it, or set "
                   "model to fixed_corotated or ",
                   0),
      0u)
      << report;
}

TEST(DeckPoreWater, IsPositive) {
  EXPECT_EQ(problems_of(with_line(19, "friction_angle = \"31 deg\"\nundrained_bulk_modulus = 0")),
            "deck.toml:20:26: material.sand.undrained_bulk_modulus = 0: is too small; allowed: "
            "above 0 Pa\n");
}

TEST(DeckPoreWater, ItsFieldsExistWithItOnly) {
  const std::vector<std::string> fields{"output.fields=[\"pore_pressure\", \"effective_stress\"]"};
  EXPECT_NE(problems_of(good_deck, fields), "");
  const std::string wet =
      with_line(19, "friction_angle = \"31 deg\"\nundrained_bulk_modulus = \"2 GPa\"");
  EXPECT_EQ(problems_of(wet, fields), "");
  Problems problems;
  const Deck deck = read_deck_text(wet, "deck.toml", fields, problems);
  const auto simulation = Simulation::create(build_setup(deck));
  EXPECT_EQ(simulation->particles(deck.output.fields).fields[0].values[0], 0);
  EXPECT_NE(resolved_toml(deck).find("undrained_bulk_modulus = 2"), std::string::npos);
}

}  // namespace
}  // namespace scree::testing_decks
