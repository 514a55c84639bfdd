// SPDX-License-Identifier: Apache-2.0
//
// The constitutive laws of the reference method against published numbers and exact identities.
#include "verification/reference/material.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "verification/reference/closed_forms.hpp"
#include "verification/support/random.hpp"

namespace scree::reference {
namespace {

Matrix stretched(double a, double b, double c) { return Vector(a, b, c).asDiagonal(); }

/// Carries a fresh state to deformation gradient F in one step and returns its Kirchhoff stress.
Matrix stress_at(const Material& material, const Matrix& F) {
  MaterialState state;
  return material.advance(state, F - Matrix::Identity(), 1.0);
}

/// tau = dpsi/dF F^T by central differences, at random F; none at F = I.
void expect_stress_of_energy(const Material& material, double youngs_modulus) {
  scree::testing::Random random(31);
  for (int n = 0; n < 50; ++n) {
    const Matrix F = Matrix::Identity() + random.matrix(0.2);
    Matrix P;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        MaterialState plus, minus;
        plus.F = minus.F = F;
        plus.F(i, j) += 1e-5;
        minus.F(i, j) -= 1e-5;
        P(i, j) = (material.energy_density(plus) - material.energy_density(minus)) / 2e-5;
      }
    // Differences of energies of 1e5 Pa over 1e-5: rounding 1e-6, truncation 1e-10 E.
    EXPECT_LT((stress_at(material, F) - P * F.transpose()).norm(), 1e-8 * youngs_modulus);
  }
  EXPECT_EQ(stress_at(material, Matrix::Identity()).norm(), 0);
}

TEST(ReferenceMaterial, stress_is_the_derivative_of_the_energy) {
  expect_stress_of_energy(*fixed_corotated(1e6, 0.3), 1e6);
  expect_stress_of_energy(*neo_hookean(1e6, 0.3), 1e6);
}

TEST(ReferenceMaterial, fixed_corotated_is_linear_in_uniaxial_strain_and_objective) {
  const auto material = fixed_corotated(1e6, 0.3);
  for (double s : {0.4, 0.9, 1.3, 2.0})
    EXPECT_NEAR(stress_at(*material, stretched(s, 1, 1))(0, 0) / s,
                oedometric_modulus(1e6, 0.3) * (s - 1), 1e-8);
  const Matrix Q = Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix();
  const Matrix F = stretched(0.8, 1.1, 1.3);
  EXPECT_LT((stress_at(*material, Q * F) - Q * stress_at(*material, F) * Q.transpose()).norm(),
            1e-7);
}

TEST(ReferenceMaterial, drucker_prager_returns_as_published) {
  // E = 10 MPa, nu = 0.3, phi = 30 deg on the outer cone.
  const double alpha = cone_alpha(cone_slope_compression(std::numbers::pi / 6));
  EXPECT_NEAR(alpha, 0.326598632, 1e-9);
  const auto sand = drucker_prager({1e7, 0.3, alpha});
  MaterialState state;
  const Matrix F = stretched(std::exp(-0.02), std::exp(0.006), std::exp(0.004));
  const Matrix tau = sand->advance(state, F - Matrix::Identity(), 1.0);
  // e - dg e_dev/|e_dev|, dg = |e_dev| + (3 lambda + 2 mu)/(2 mu) alpha tr e; numbers of an
  // independent script.
  const double expected[3] = {-0.01197927458173, 0.00150839376577, 0.00047088081596};
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(std::log(state.F(a, a)), expected[a], 1e-14);
  EXPECT_NEAR(state.equivalent_plastic_strain, std::sqrt(2.0 / 3.0) * 0.009846890, 1e-9);
  const double p = -tau.trace() / 3;
  const Matrix deviator = tau + p * Matrix::Identity();
  EXPECT_NEAR(std::sqrt(1.5) * deviator.norm() / p, 1.2, 1e-12);
  EXPECT_NEAR(std::log(state.F.determinant()), -0.010, 1e-15);
  EXPECT_NEAR(state.log_volume_ratio, -0.010, 1e-15);
}

TEST(ReferenceMaterial, sand_is_stress_free_after_expansion_and_equal_compression) {
  const auto sand = drucker_prager({1e7, 0.3, 0.3});
  MaterialState state;
  const Matrix one = Matrix::Identity();
  const double s = std::exp(0.01);
  EXPECT_EQ(sand->advance(state, (s - 1) * one, 1.0).norm(), 0);
  EXPECT_NEAR(state.volume_correction, 0.03, 1e-15);
  EXPECT_LT(sand->advance(state, (1 / s - 1) * one, 1.0).norm(), 1e7 * 1e-14);
  EXPECT_NEAR(state.volume_correction, 0, 1e-15);
}

TEST(ReferenceMaterial, sand_follows_the_oedometer_path) {
  const double phi = std::numbers::pi / 6;
  const auto sand = drucker_prager({1e7, 0.2, cone_alpha(cone_slope_compression(phi))});
  MaterialState state;
  const double factor = std::pow(0.9, 1.0 / 200);
  Matrix L = Matrix::Zero();
  L(0, 0) = factor - 1;
  for (int n = 0; n < 200; ++n) sand->advance(state, L, 1.0);
  const OedometerStress expected = sand_oedometer(0.9, 1e7, 0.2, phi);
  EXPECT_NEAR(-state.tau(0, 0) / 0.9 / expected.axial, 1, 1e-10);
  EXPECT_NEAR(-state.tau(1, 1) / 0.9 / expected.lateral, 1, 1e-10);
}

TEST(ReferenceMaterial, cohesion_lets_sand_carry_the_stress_of_its_tip) {
  const Lame lame(1e7, 0.3);
  const double phi = 0.5, cohesion = 5e3;
  const double shift = cohesion / std::tan(phi) / (3 * lame.lambda + 2 * lame.mu);
  const auto sand = drucker_prager({1e7, 0.3, cone_alpha(cone_slope_compression(phi)), 0, shift});
  MaterialState state;
  const Matrix tau = sand->advance(state, 0.05 * Matrix::Identity(), 1.0);
  // Tip of the cone: isotropic tension c cot(phi).
  EXPECT_LT((tau - cohesion / std::tan(phi) * Matrix::Identity()).norm(), 1e-7);
}

TEST(ReferenceMaterial, dilation_keeps_the_cone_and_grows_volume_as_its_angle_says) {
  const double alpha = 0.3, a = 0.1;
  const auto sand = drucker_prager({1e7, 0.3, alpha, a});
  MaterialState state;
  const Matrix F = stretched(std::exp(-0.02), std::exp(0.006), std::exp(0.004));
  const Matrix tau = sand->advance(state, F - Matrix::Identity(), 1.0);
  const double p = -tau.trace() / 3;
  EXPECT_NEAR(std::sqrt(1.5) * (tau + p * Matrix::Identity()).norm() / p, alpha * std::sqrt(13.5),
              1e-12);
  const double plastic_volume = -0.010 - std::log(state.F.determinant());
  const double plastic_shear = state.equivalent_plastic_strain / std::sqrt(2.0 / 3.0);
  EXPECT_NEAR(plastic_volume, 3 * a * plastic_shear, 1e-14);
}

TEST(ReferenceMaterial, fluid_pressure_follows_its_law) {
  const auto water = j_fluid(1e4, 7, 0.5);
  MaterialState state;
  Matrix L = Matrix::Zero();
  L(0, 1) = 2;
  L(0, 0) = -0.1;
  const Matrix tau = water->advance(state, L, 0.5);
  const double J = 1 - 0.05, p = 1e4 * (std::pow(J, -7) - 1);
  EXPECT_NEAR(tau(0, 0), J * (0.5 * 2 * -0.1 - p), 1e-8);
  EXPECT_NEAR(tau(0, 1), J * 0.5 * 2, 1e-12);
  EXPECT_NEAR(tau(2, 2), -J * p, 1e-8);
  MaterialState plus = state, minus = state;
  plus.log_volume_ratio += 1e-5;
  minus.log_volume_ratio -= 1e-5;
  // dpsi/d ln J = -J p.
  EXPECT_NEAR((water->energy_density(plus) - water->energy_density(minus)) / 2e-5, -J * p, 1e-4);
}

}  // namespace
}  // namespace scree::reference
