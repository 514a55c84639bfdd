// SPDX-License-Identifier: Apache-2.0
//
// Undrained soil at a material point (case V36a): the closed forms of Biot's theory for
// incompressible grains (alpha = 1) and the water's share in wave speed and energy.
#include "materials/pore_water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "materials/fixed_corotated.hpp"
#include "materials/material_point.hpp"
#include "materials/undrained_point.hpp"

namespace scree {
namespace {

constexpr double young = 1e7, poisson = 0.3, porosity = 0.4, water = 2.2e9;
constexpr double bulk = young / (3 * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
constexpr double pore_bulk = water / porosity;  // K_u
constexpr double density = 2000;

std::unique_ptr<MaterialPoint> soil() {
  return make_material_point("fixed_corotated", FixedCorotated::Input{young, poisson}, density, 3);
}
std::unique_ptr<MaterialPoint> undrained_soil() {
  return add_pore_water(soil(), pore_bulk, density);
}

Mat3<double> diagonal(double x, double y, double z) {
  Mat3<double> m = zero3<double>();
  m(0, 0) = x, m(1, 1) = y, m(2, 2) = z;
  return m;
}

// The closed forms are those of small strains. At a strain of 1e-7 the terms of second order are
// near 1e-7 of the stress, the rounding of the stretch 1e-16/1e-7 = 1e-9 of it.
constexpr double small = 1e-7, tolerance = 1e-6;

TEST(PoreWater, IsotropicLoadGivesSkemptonsB) {
  const auto point = undrained_soil();
  const Sym3<double> tau = point->advance(diagonal(-small, -small, -small), 1);
  const double total = -tau.xx / point->volume_ratio();
  const double skempton = pore_bulk / (pore_bulk + bulk);
  EXPECT_NEAR(skempton, 0.998487, 5e-7);  // the catalogue's six digits
  EXPECT_NEAR(point->entries().back() / total, skempton, tolerance);
}

TEST(PoreWater, OedometricLoadGivesBiotsFactor) {
  const auto point = undrained_soil();
  const Sym3<double> tau = point->advance(diagonal(-small, 0, 0), 1);
  const double factor = pore_bulk / (bulk + pore_bulk + 4 * shear / 3);
  EXPECT_NEAR(factor, 0.997558, 5e-7);
  EXPECT_NEAR(point->entries().back() * point->volume_ratio() / -tau.xx, factor, tolerance);
}

TEST(PoreWater, UndrainedPoissonsRatioIsThatOfTheStiffenedSolid) {
  // Lateral strain at which the lateral stress vanishes; the response to small strains is linear.
  const auto lateral = [](double strain) {
    const auto point = undrained_soil();
    return point->advance(diagonal(-small, strain, strain), 1).yy;
  };
  const double at_zero = lateral(0), slope = (lateral(0.5 * small) - at_zero) / (0.5 * small);
  const double measured = -at_zero / slope / small;
  const double undrained = bulk + pore_bulk;
  const double expected = (3 * undrained - 2 * shear) / (2 * (3 * undrained + shear));
  EXPECT_NEAR(expected, 0.499651, 5e-7);
  EXPECT_NEAR(measured, expected, tolerance);
}

TEST(PoreWater, ShearAtConstantVolumeMakesNoPressure) {
  const auto point = undrained_soil();
  Mat3<double> L = zero3<double>();
  L(0, 1) = 0.3;
  point->advance(L, 1);
  EXPECT_NEAR(point->entries().back(), 0, 1e-15 * pore_bulk);  // rounding of det F
}

TEST(PoreWater, PressureFollowsTheVolumeAtAnyStrain) {
  const auto point = undrained_soil();
  for (int i = 0; i < 100; ++i) point->advance(diagonal(-2e-3, 1e-3, -3e-3), 1);
  const double expected = -pore_bulk * std::log(point->volume_ratio());
  EXPECT_NEAR(point->entries().back() / expected, 1, 1e-12);
}

/// d(energy) = tau : L for small L about a compressed state.
TEST(PoreWater, StressIsTheDerivativeOfTheEnergy) {
  const auto point = undrained_soil();
  point->advance(diagonal(-0.02, -0.01, 0.005), 1);
  const std::vector<double> state = point->entries();
  const Sym3<double> tau = point->stress();
  constexpr double h = 1e-5;
  const auto energy = [&](double x, double y, double z) {
    point->set_entries(state);
    point->advance(diagonal(std::expm1(x), std::expm1(y), std::expm1(z)), 1);
    return point->energy_density();
  };
  // Central differences in ln of the stretches: h^2 of the modulus, rounding 1e-16 E/h.
  const double limit = 1e-8 * pore_bulk;
  EXPECT_NEAR((energy(h, 0, 0) - energy(-h, 0, 0)) / (2 * h), tau.xx, limit);
  EXPECT_NEAR((energy(0, h, 0) - energy(0, -h, 0)) / (2 * h), tau.yy, limit);
  EXPECT_NEAR((energy(0, 0, h) - energy(0, 0, -h)) / (2 * h), tau.zz, limit);
}

TEST(PoreWater, EnergyOfSmallPressuresKeepsItsDigits) {
  for (const double s : {1e-9, 1e-4, 9.99e-3, 1.001e-2, 0.5, -9.99e-3, -1.001e-2, -0.5}) {
    const long double exact = std::expm1(static_cast<long double>(s)) - s;
    // Below 1e-6 the long difference has fewer digits than s^2/2 (1 + s/3).
    const double expected = std::abs(s) < 1e-6 ? s * s / 2 * (1 + s / 3) : double(exact);
    EXPECT_NEAR(pore_water::energy_density(1, s * pore_bulk, pore_bulk) / (pore_bulk * expected), 1,
                1e-12)
        << s;  // series: s^5/2520; difference: 2e-16/(s/2)
  }
}

TEST(PoreWater, WaveSpeedIsThatOfUndrainedCompression) {
  const double M = bulk + 4 * shear / 3 + pore_bulk;
  EXPECT_NEAR(undrained_soil()->wave_speed(), std::sqrt(M / density), 1e-12 * std::sqrt(M));
  // Compressed: the tangent of P_11 with the stretch s, spatial speed s^2 dP_11/ds / rho0.
  const auto point = undrained_soil();
  point->advance(diagonal(-0.05, 0, 0), 1);
  const std::vector<double> state = point->entries();
  const auto nominal = [&](double e) {
    point->set_entries(state);
    return point->advance(diagonal(e, 0, 0), 1).xx / (0.95 * (1 + e));
  };
  constexpr double h = 1e-6;
  const double tangent = 0.95 * (nominal(h) - nominal(-h)) / (2 * h) / density;
  point->set_entries(state);
  EXPECT_GE(point->wave_speed(), std::sqrt(tangent) * (1 - 1e-8));
  EXPECT_LE(point->wave_speed(), std::sqrt(tangent) * 1.01);
}

TEST(PoreWater, EntriesPutTheStateBack) {
  const auto point = undrained_soil();
  point->advance(diagonal(-0.01, 0.004, 0), 1);
  const auto copy = undrained_soil();
  copy->set_entries(point->entries());
  EXPECT_EQ(copy->stress().xx, point->stress().xx);
  EXPECT_EQ(copy->energy_density(), point->energy_density());
  EXPECT_EQ(copy->entries(), point->entries());
}

}  // namespace
}  // namespace scree
