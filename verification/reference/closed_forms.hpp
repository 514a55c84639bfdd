// SPDX-License-Identifier: Apache-2.0
//
// Exact and published results that the tests compare with. SI units; header only.
#pragma once

#include <cmath>
#include <numbers>

namespace scree::reference {

// ---------------------------------------------------------------- motion

struct Fall {
  double position, velocity;
};

/// Position and velocity after n steps dt of symplectic Euler under constant acceleration g:
/// v_n = v0 + g n dt, x_n = v0 n dt + g dt^2 n (n + 1)/2 (sum of the first n velocities).
inline Fall symplectic_euler_fall(int n, double dt, double g, double v0 = 0) {
  return {v0 * n * dt + g * dt * dt * n * (n + 1) / 2.0, v0 + g * n * dt};
}

/// Block on an incline of `theta` with Coulomb friction, from velocity v0 >= 0, without turning
/// back: a = g (sin theta - mu cos theta), or at rest if v0 = 0 and mu >= tan theta.
struct SlidingBlock {
  double acceleration;
  double v0;
  SlidingBlock(double theta, double friction, double g = 9.81, double initial_velocity = 0)
      : acceleration(g * (std::sin(theta) - friction * std::cos(theta))), v0(initial_velocity) {
    if (v0 == 0 && friction >= std::tan(theta)) acceleration = 0;
  }
  double displacement(double t) const { return v0 * t + acceleration * t * t / 2; }
  double velocity(double t) const { return v0 + acceleration * t; }
};

/// Factor of safety of an infinite slope: (c + gamma z cos^2 beta tan phi)/(gamma z sin beta cos
/// beta), dry.
inline double infinite_slope_safety(double cohesion, double phi, double unit_weight, double depth,
                                    double beta) {
  return (cohesion + unit_weight * depth * std::cos(beta) * std::cos(beta) * std::tan(phi)) /
         (unit_weight * depth * std::sin(beta) * std::cos(beta));
}

/// Acceleration of a layer that slides on its base plane: g (sin theta - mu_e cos theta), mu_e =
/// M/sqrt(3) for the cone q = M p with isochoric flow in plane strain.
inline double infinite_slope_acceleration(double theta, double cone_slope, double g = 9.81) {
  return g * (std::sin(theta) - cone_slope / std::sqrt(3.0) * std::cos(theta));
}

// ---------------------------------------------------------------- elasticity

/// lambda + 2 mu = E (1 - nu)/((1 + nu)(1 - 2 nu)) [Pa].
inline double oedometric_modulus(double youngs_modulus, double poissons_ratio) {
  return youngs_modulus * (1 - poissons_ratio) / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
}

// ---------------------------------------------------------------- granular matter

/// Slope M of the cone q = M p that meets Mohr-Coulomb's friction angle in triaxial compression.
inline double cone_slope_compression(double phi) { return 6 * std::sin(phi) / (3 - std::sin(phi)); }
inline double cone_slope_extension(double phi) { return 6 * std::sin(phi) / (3 + std::sin(phi)); }
/// The same in plane strain with isochoric flow.
inline double cone_slope_plane_strain(double phi) { return std::sqrt(3.0) * std::sin(phi); }
/// alpha of the cone in strain form (Klar et al. 2016): |dev e| + (3 lambda + 2 mu)/(2 mu) alpha tr
/// e = 0.
inline double cone_alpha(double cone_slope) { return std::sqrt(2.0 / 27.0) * cone_slope; }

struct OedometerStress {
  double axial, lateral;  ///< Cauchy, compression positive [Pa]
};

/// Cohesionless sand on the compression cone, Hencky elasticity, F = diag(J, 1, 1), monotonic
/// compression from 1. Elastic while 3 (1 - 2 nu)/(1 + nu) <= M, else plastic from the start: p =
/// -K ln J, tau_1 = (1 + 2 M/3) p, tau_3 = (1 - M/3) p.
inline OedometerStress sand_oedometer(double J, double youngs_modulus, double poissons_ratio,
                                      double phi) {
  const double mu = youngs_modulus / (2 * (1 + poissons_ratio));
  const double lambda = 2 * mu * poissons_ratio / (1 - 2 * poissons_ratio);
  const double M = cone_slope_compression(phi), e = -std::log(J);
  if (3 * (1 - 2 * poissons_ratio) / (1 + poissons_ratio) <= M)
    return {(lambda + 2 * mu) * e / J, lambda * e / J};
  const double p = (lambda + 2 * mu / 3) * e;
  return {(1 + 2 * M / 3) * p / J, (1 - M / 3) * p / J};
}

/// Final run-out of a collapsing column in a channel, (d_inf - d0)/d0 by the aspect ratio a =
/// h0/d0: 1.2 a for a < 1.8, 1.9 a^(2/3) for a > 2.8 (Lube et al., Phys. Rev. E 72, 041301, 2005);
/// between them the switch is put at 2.3.
inline double column_runout(double a) { return a < 2.3 ? 1.2 * a : 1.9 * std::cbrt(a * a); }

// ---------------------------------------------------------------- fluids

/// Gauge pressure at a depth of a fluid p = B ((rho/rho0)^gamma - 1) at rest: dp/dz = rho g gives,
/// with n = (gamma - 1)/gamma, p = B ((1 + n rho0 g z/B)^(1/n) - 1).
inline double hydrostatic_pressure(double depth, double density, double g, double B, double gamma) {
  const double n = (gamma - 1) / gamma;
  return B * (std::pow(1 + n * density * g * depth / B, 1 / n) - 1);
}

}  // namespace scree::reference
