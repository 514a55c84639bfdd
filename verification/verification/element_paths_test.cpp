// SPDX-License-Identifier: Apache-2.0
// Closed forms of laboratory tests, through the element driver (decks of inputs/element).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "materials/registry.hpp"
#include "solver/element/element_test.hpp"
#include "verification/support/example_decks.hpp"

namespace scree {
namespace {

/// Rounding of a state that thousands of exact steps have led to.
constexpr double exact = 1e-9;

/// Drives a deck of inputs/element; an empty table where this build lacks the law.
ElementResult drive(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const auto deck = testing::element_example(name, overrides);
  return deck ? drive_element(*deck) : ElementResult{};
}

#define SKIP_WITHOUT_LAW(result)                                 \
  if ((result).rows.empty() && !::testing::Test::HasFailure()) { \
    GTEST_SKIP() << "this build has no such law";                \
  }                                                              \
  ASSERT_FALSE((result).rows.empty())

double sigma_1(const ElementRow& row) { return -row.cauchy.xx; }
double sigma_3(const ElementRow& row) { return -row.cauchy.zz; }
/// J from the undeformed state, where the deck gives no void ratio.
double volume_ratio(const ElementRow& row) { return 1 + row.void_ratio; }

/// Where a field begins in the entries of a row.
std::size_t place_of(const ElementResult& result, const std::string& name) {
  std::size_t place = 0;
  for (const StateField& field : result.fields) {
    if (field.name == name) return place;
    place += static_cast<std::size_t>(field.components);
  }
  ADD_FAILURE() << "no field " << name;
  return 0;
}

double degrees(double angle) { return angle * std::acos(-1.0) / 180; }
/// Slope q/p of the cone through triaxial compression.
double cone(double friction) { return 6 * std::sin(friction) / (3 - std::sin(friction)); }
double passive(double friction) { return (1 + std::sin(friction)) / (1 - std::sin(friction)); }

TEST(ElementElastic, OedometerFollowsEachLawAtEveryStep) {
  const double e = 10e6, nu = 0.3;
  const double lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), mu = e / (2 * (1 + nu));
  const auto check = [&](const std::string& model, auto stress) {
    const ElementResult result = drive(model + "_oedometer");
    if (result.rows.empty()) return;
    EXPECT_EQ(result.rows.size(), 201u);
    for (const ElementRow& row : result.rows) {
      // Rounding of a product of 200 stretches, relative to the modulus.
      EXPECT_NEAR(sigma_1(row), stress(row.strain.axial), 1e-13 * e) << model << row.step;
      EXPECT_EQ(row.strain.volumetric, row.strain.axial);
    }
    EXPECT_DOUBLE_EQ(result.rows.back().strain.axial, 0.2);
  };
  check("hencky", [&](double x) { return (lambda + 2 * mu) * x * std::exp(x); });
  check("neo_hookean",
        [&](double x) { return (-mu * std::expm1(-2 * x) + lambda * x) * std::exp(x); });
  check("fixed_corotated", [&](double x) { return -(lambda + 2 * mu) * std::expm1(-x); });
}

TEST(ElementElastic, UniaxialStressIsHeldAndHenckyIsLinearInKirchhoffStress) {
  const ElementResult result =
      drive("hencky_oedometer", {"path.type=triaxial_drained", "path.confining_pressure=0"});
  SKIP_WITHOUT_LAW(result);
  for (const ElementRow& row : result.rows) {
    EXPECT_NEAR(row.cauchy.zz, 0, 1e-10 * std::max(1e-3, sigma_1(row)));
    EXPECT_NEAR(volume_ratio(row) * sigma_1(row), 10e6 * row.strain.axial, exact * 10e6);
    EXPECT_NEAR(row.strain.volumetric, (1 - 2 * 0.3) * row.strain.axial, exact);
  }
}

TEST(ElementElastic, ClosedCycleOfStrainLeavesNoStress) {
  const ElementResult result = drive("hencky_cycle");
  SKIP_WITHOUT_LAW(result);
  EXPECT_GT(result.rows[200].deviatoric(), 1e6);
  const ElementRow& last = result.rows.back();
  EXPECT_EQ(last.strain.shear, 0);
  EXPECT_LE(norm(last.cauchy), 1e-12 * 10e6);
}

TEST(ElementElastic, HeldStressIsHeldAtEveryStep) {
  const ElementResult result = drive("neo_hookean_triaxial_drained");
  SKIP_WITHOUT_LAW(result);
  for (const ElementRow& row : result.rows) {
    EXPECT_NEAR(-row.cauchy.yy, 100e3, 1e-10 * std::max(100e3, sigma_1(row))) << row.step;
    EXPECT_EQ(row.cauchy.yy, row.cauchy.zz);
  }
}

TEST(ElementVonMises, OedometerYieldsAndThenFollowsTheBulkModulus) {
  const ElementResult result = drive("von_mises_oedometer");
  SKIP_WITHOUT_LAW(result);
  const double e = 20e6, nu = 0.45, yield = 100e3;
  const double bulk = e / (3 * (1 - 2 * nu)), mu = e / (2 * (1 + nu));
  for (std::size_t i = 0; i <= 500; ++i) {
    const ElementRow& row = result.rows[i];
    const double x = row.strain.axial;
    const double expected =
        x <= yield / (2 * mu) ? (bulk + 4 * mu / 3) * x : bulk * x + 2 * yield / 3;
    EXPECT_NEAR(volume_ratio(row) * sigma_1(row), expected, exact * yield) << i;
  }
}

TEST(ElementVonMises, UndrainedStrengths) {
  const ElementResult triaxial = drive("von_mises_triaxial_undrained");
  SKIP_WITHOUT_LAW(triaxial);
  const ElementRow& last = triaxial.rows.back();
  EXPECT_NEAR(volume_ratio(last) * last.deviatoric(), 100e3, exact * 100e3);
  const ElementResult shear = drive("von_mises_simple_shear");
  // The principal axes of stress are about g/2 ahead of 45 degrees: relative error g^2/2.
  EXPECT_NEAR(shear.rows.back().cauchy.xy, 100e3 / std::sqrt(3), 0.5 * 0.05 * 0.05 * 100e3);
}

TEST(ElementDruckerPrager, OedometerRestsAtTheActiveRatio) {
  const ElementResult result = drive("drucker_prager_oedometer");
  SKIP_WITHOUT_LAW(result);
  const double bulk = 10e6 / (3 * (1 - 2 * 0.2)), m = cone(degrees(30));
  const double p = -bulk * std::log(0.9) / 0.9;
  const ElementRow& last = result.rows.back();
  EXPECT_NEAR(sigma_1(last) / ((1 + 2 * m / 3) * p), 1, exact);
  EXPECT_NEAR(sigma_3(last) / ((1 - m / 3) * p), 1, exact);
  EXPECT_NEAR(sigma_1(last), 1170672.4, 0.05);
  EXPECT_NEAR(sigma_3(last), 390224.1, 0.05);
}

TEST(ElementDruckerPrager, TriaxialStrengthDrainedAndAtConstantVolume) {
  const double m = cone(degrees(30));
  const ElementResult drained = drive("drucker_prager_triaxial_drained");
  SKIP_WITHOUT_LAW(drained);
  EXPECT_NEAR(drained.rows.back().deviatoric(), 3 * m * 100e3 / (3 - m), exact * 200e3);
  const ElementResult undrained = drive("drucker_prager_triaxial_undrained");
  const ElementRow& last = undrained.rows.back();
  EXPECT_NEAR(last.pressure(), 100e3, exact * 100e3);
  EXPECT_NEAR(last.deviatoric(), m * 100e3, exact * 100e3);
  // The cell pressure stays, p too: the pore pressure is a third of q.
  EXPECT_NEAR(last.pore_pressure.value(), last.deviatoric() / 3, exact * 100e3);
}

TEST(ElementDruckerPrager, SimpleShearAtConstantVolumeKeepsThePressure) {
  const ElementResult result =
      drive("drucker_prager_triaxial_undrained", {"path.type=simple_shear", "path.strain=0.2"});
  SKIP_WITHOUT_LAW(result);
  for (const ElementRow& row : result.rows) EXPECT_NEAR(row.pressure(), 100e3, exact * 100e3);
  EXPECT_NEAR(result.rows.back().deviatoric(), cone(degrees(30)) * 100e3, exact * 100e3);
}

TEST(ElementMohrCoulomb, TriaxialStrength) {
  const ElementResult drained = drive("mohr_coulomb_triaxial_drained");
  SKIP_WITHOUT_LAW(drained);
  const double kp = passive(degrees(30)), c = 5e3;
  const ElementRow& last = drained.rows.back();
  // The law is one of Kirchhoff stress.
  const double expected = kp * sigma_3(last) + 2 * c * std::sqrt(kp) / volume_ratio(last);
  EXPECT_NEAR(sigma_1(last) / expected, 1, exact);
  EXPECT_NEAR(sigma_3(last), 100e3, 1e-10 * sigma_1(last));
}

TEST(ElementMohrCoulomb, SimpleShearAtConstantNormalStressReachesDavisRatio) {
  const auto ratio = [](const std::string& dilation) {
    const ElementResult result = drive(
        "mohr_coulomb_simple_shear",
        {"material.soil.cohesion=0", "material.soil.dilation_angle=\"" + dilation + " deg\""});
    return result.rows.empty() ? 0 : result.rows.back().cauchy.xy / -result.rows.back().cauchy.yy;
  };
  const double phi = degrees(30), without = ratio("0");
  if (without == 0) GTEST_SKIP() << "this build has no such law";
  // Davis (1968) for small strain; the shear is 0.1.
  const double error = 0.5 * 0.1 * 0.1;
  EXPECT_NEAR(without, std::sin(phi), error);
  const double psi = degrees(15);
  EXPECT_NEAR(ratio("15"), std::sin(phi) * std::cos(psi) / (1 - std::sin(phi) * std::sin(psi)),
              error);
}

TEST(ElementMohrCoulomb, WaterInThePoresTakesUpTheElasticPressure) {
  const ElementResult result = drive("mohr_coulomb_triaxial_undrained");
  SKIP_WITHOUT_LAW(result);
  for (const ElementRow& row : result.rows) {
    EXPECT_NEAR(*row.pore_pressure + sigma_3(row), 100e3, 1e-10 * 300e3) << row.step;
  }
  // Skempton: u = B q/3, B = Kw/(Kw + K); stresses are per present area, which changes by 1 %.
  const ElementRow& elastic = result.rows[50];
  const double bulk = 20e6 / (3 * (1 - 2 * 0.3)), b = 2e9 / (2e9 + bulk);
  EXPECT_NEAR(*elastic.pore_pressure / (b * elastic.deviatoric() / 3), 1, 0.01);
}

TEST(ElementMohrCoulomb, PlaneStrainAtConstantVolume) {
  const ElementResult result = drive("mohr_coulomb_plane_strain");
  SKIP_WITHOUT_LAW(result);
  const ElementRow& last = result.rows.back();
  // The cohesion is one of Kirchhoff stress; J is that of the confinement.
  const double phi = degrees(30), c = 5e3 / volume_ratio(last);
  const double shear = -last.cauchy.xx + last.cauchy.yy;
  EXPECT_NEAR(shear / (2 * (100e3 * std::sin(phi) + c * std::cos(phi))), 1, exact);
  EXPECT_NEAR(last.pressure() / 100e3, 1, exact);
  EXPECT_NEAR(sigma_3(last) / 100e3, 1, exact);
}

TEST(ElementMohrCoulomb, OedometerYieldsAndThenFollowsTheSurface) {
  const ElementResult result = drive("mohr_coulomb_oedometer");
  SKIP_WITHOUT_LAW(result);
  const double kp = passive(degrees(30)), c = 5e3, nu = 0.2;
  const double first = 2 * c * std::sqrt(kp) / (1 - kp * nu / (1 - nu));
  int elastic = 0;
  for (const ElementRow& row : result.rows) {
    const double s1 = volume_ratio(row) * sigma_1(row), s3 = volume_ratio(row) * sigma_3(row);
    const double expected = s1 < first ? s1 * nu / (1 - nu) : (s1 - 2 * c * std::sqrt(kp)) / kp;
    EXPECT_NEAR(s3, expected, exact * 1e6) << row.step;
    elastic += s1 < first;
  }
  EXPECT_GT(elastic, 10);
  EXPECT_LT(elastic, 250);
}

TEST(ElementVonMises, CyclesHarden) {
  const ElementResult result = drive("von_mises_cyclic_shear");
  SKIP_WITHOUT_LAW(result);
  const std::size_t strain = place_of(result, "equivalent_plastic_strain");
  double before = 0;
  for (std::size_t turn = 500; turn <= 4000; turn += 500) {
    const ElementRow& row = result.rows[turn];
    const double yield = 100e3 + 500e3 * row.entries.at(strain);
    EXPECT_NEAR(row.deviatoric() / yield, 1, exact) << turn;
    // The principal axes are about g/2 ahead of 45 degrees: relative error g^2/2.
    const double sign = turn % 1000 == 500 ? 1 : -1;
    EXPECT_NEAR(sign * std::sqrt(3) * row.cauchy.xy / yield, 1, 0.5 * 0.02 * 0.02) << turn;
    // From turn to turn (0.04 - 2 tau/mu)/sqrt(3), tau below 90 kPa.
    EXPECT_GT(yield, before + 500e3 * 0.008);
    before = yield;
  }
}

TEST(ElementDruckerPrager, FrictionHardensWithThePlasticShear) {
  const ElementResult result = drive("drucker_prager_hardening");
  SKIP_WITHOUT_LAW(result);
  const std::size_t strain = place_of(result, "equivalent_plastic_strain");
  for (const ElementRow& row : result.rows) {
    const double x = std::sqrt(1.5) * row.entries.at(strain);
    const double phi = 35 + (9 * x - 10) * std::exp(-0.2 * x);
    if (row.step < 100) continue;  // the first steps are elastic
    EXPECT_NEAR(row.deviatoric() / (cone(degrees(phi)) * row.pressure()), 1, exact) << row.step;
  }
}

TEST(ElementWater, IsotropicCompressionMeasuresSkemptonsB) {
  const ElementResult result = drive("hencky_undrained_isotropic");
  SKIP_WITHOUT_LAW(result);
  const double bulk = 9e6 / (3 * (1 - 2 * 0.2)), water = 45e6, b = water / (water + bulk);
  for (const ElementRow& row : result.rows) {
    const double v = row.strain.volumetric, u = row.pore_pressure.value();
    EXPECT_NEAR(u, water * v, exact * water * 0.01) << row.step;
    // Hencky's stress is per undeformed area: J p = K v.
    const double effective = std::exp(-v) * row.pressure();
    EXPECT_NEAR(u, b * (u + effective), exact * water * 0.01) << row.step;
  }
  EXPECT_DOUBLE_EQ(result.rows.back().strain.volumetric, 0.01);
}

TEST(ElementWater, StaysInThePoresOnEveryPath) {
  struct Case {
    const char* deck;
    double held;  ///< total normal stress on axis 2, 0: none
  };
  const double water = 50e6;
  for (const Case& test : {Case{"mohr_coulomb_oedometer", 0}, Case{"mohr_coulomb_plane_strain", 0},
                           Case{"mohr_coulomb_simple_shear", 100e3}}) {
    const ElementResult result =
        drive(test.deck, {"material.soil.undrained_bulk_modulus=\"50 MPa\"",
                          "material.soil.dilation_angle=\"10 deg\""});
    SKIP_WITHOUT_LAW(result);
    double largest = 0;
    for (const ElementRow& row : result.rows) {
      const double u = row.pore_pressure.value();
      EXPECT_NEAR(u, water * row.strain.volumetric, exact * water) << test.deck << row.step;
      if (test.held > 0) {
        EXPECT_NEAR(u - row.cauchy.yy, test.held, 1e-10 * 1e6) << row.step;  // stresses below 1 MPa
      }
      largest = std::max(largest, std::abs(u));
    }
    EXPECT_GT(largest, 1e3) << test.deck;
  }
}

TEST(ElementCamClay, NormalAndSwellingLines) {
  const ElementResult result = drive("modified_cam_clay_isotropic");
  SKIP_WITHOUT_LAW(result);
  const auto slope = [&](std::size_t a, std::size_t b) {
    const ElementRow &first = result.rows[a], &second = result.rows[b];
    return (first.void_ratio - second.void_ratio) / std::log(second.pressure() / first.pressure());
  };
  EXPECT_NEAR(slope(0, 500), 0.2, 1e-4 * 0.2);
  EXPECT_NEAR(slope(500, 1000), 0.2, 1e-4 * 0.2);
  EXPECT_NEAR(slope(1001, 2000), 0.04, 1e-4 * 0.04);
}

TEST(ElementCamClay, UndrainedCriticalStates) {
  for (const auto& [name, ocr] : {std::pair{"modified_cam_clay_triaxial_undrained", 1.0},
                                  std::pair{"modified_cam_clay_overconsolidated", 8.0}}) {
    const ElementResult result = drive(name);
    SKIP_WITHOUT_LAW(result);
    const double p = 100e3 * std::pow(ocr / 2, (0.2 - 0.04) / 0.2);
    const ElementRow& last = result.rows.back();
    // The return map is of first order in the step; the approach is exponential.
    EXPECT_NEAR(last.pressure() / p, 1, 5e-3) << name;
    EXPECT_NEAR(last.deviatoric() / p, 1, 5e-3) << name;
  }
}

TEST(ElementCamClay, DrainedCriticalState) {
  const ElementResult result = drive("modified_cam_clay_triaxial_drained");
  SKIP_WITHOUT_LAW(result);
  const double p = 3 * 100e3 / (3 - 1.0);
  EXPECT_NEAR(result.rows.back().pressure() / p, 1, 1e-3);
  EXPECT_NEAR(result.rows.back().deviatoric() / p, 1, 1e-3);
}

TEST(ElementFluids, ShearStressIsTheRateTimesViscosity) {
  const ElementResult result = drive("newtonian_simple_shear");
  SKIP_WITHOUT_LAW(result);
  EXPECT_NEAR(result.rows.back().cauchy.xy, 10 * 10.0 / 1, exact * 100);
  const ElementResult slow = drive("newtonian_simple_shear", {"path.duration=\"10 s\""});
  EXPECT_NEAR(slow.rows.back().cauchy.xy, 10 * 10.0 / 10, exact * 100);
}

TEST(ElementPaths, GradientGivesWhatSimpleShearGives) {
  const ElementResult shear = drive("hencky_cycle");
  SKIP_WITHOUT_LAW(shear);
  Problems problems;
  const ElementDeck deck = read_element_text(R"(
[material.rock]
model = "hencky"
density = 2400
youngs_modulus = "10 MPa"
poissons_ratio = 0.3
[path]
type = "gradient"
gradient = [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]
steps = 200
)",
                                             "deck.toml", {}, problems);
  ASSERT_TRUE(problems.empty()) << problems.text();
  const ElementResult gradient = drive_element(deck);
  ASSERT_EQ(gradient.rows.size(), 201u);
  for (std::size_t i = 0; i < 201; ++i) {
    EXPECT_LE(norm(gradient.rows[i].cauchy - shear.rows[i].cauchy), 1e-12 * 10e6) << i;
    EXPECT_NEAR(gradient.rows[i].strain.shear, shear.rows[i].strain.shear, 1e-14);
  }
}

}  // namespace
}  // namespace scree
