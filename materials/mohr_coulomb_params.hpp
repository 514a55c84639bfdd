// SPDX-License-Identifier: Apache-2.0
/// \file
/// From the deck's parameters of MohrCoulomb to those of its kernels; included by mohr_coulomb.hpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "materials/mohr_coulomb.hpp"

namespace scree {

namespace detail {

/// Peak and residual values with their defaults.
struct MohrCoulombRange {
  double friction[2], cohesion[2], dilation[2];
  explicit MohrCoulombRange(const MohrCoulomb::Input& in)
      : friction{in.friction_angle, or_else(in.residual_friction_angle, in.friction_angle)},
        cohesion{in.cohesion, or_else(in.residual_cohesion, in.cohesion)},
        dilation{in.dilation_angle, or_else(in.residual_dilation_angle, in.dilation_angle)} {}

  /// Between peak, 0, and residual, 1.
  static double at(const double (&range)[2], double part) {
    return range[0] + (range[1] - range[0]) * part;
  }

 private:
  static double or_else(double given, double fallback) {
    return std::isnan(given) ? fallback : given;
  }
};

/// What plastic flow may add to the stiffness of a wave: see MohrCoulomb::wave_speed [Pa].
inline double mohr_coulomb_flow_stiffness(double lambda, double mu, double phi, double psi) {
  const double f = std::sin(phi), d = std::sin(psi);
  // Plane: the rank-two symmetric part of -u v/(N u), u = C M, v = C N.
  double u[3] = {1 + d, 0, -(1 - d)}, v[3] = {1 + f, 0, -(1 - f)}, uu = 0, vv = 0, uv = 0, nu = 0;
  for (int i = 0; i < 3; ++i) {
    const double n = v[i];
    u[i] = 2 * mu * u[i] + lambda * 2 * d;
    v[i] = 2 * mu * v[i] + lambda * 2 * f;
    uu += u[i] * u[i];
    vv += v[i] * v[i];
    uv += u[i] * v[i];
    nu += n * u[i];
  }
  double most = std::max(0.0, (std::sqrt(uu * vv) - uv) / (2 * nu));
  // Edges of triaxial compression and extension.
  const double bulk = 3 * lambda + 2 * mu;
  for (const double side : {-1.0, 1.0}) {
    const Vec3<double> r = {{1 - f, 1 + side * f, 1 + f}}, s = {{1 - d, 1 + side * d, 1 + d}};
    const double traces = (r[0] + r[1] + r[2]) * (s[0] + s[1] + s[2]);
    const double g = (dot(r, s) - lambda / bulk * traces) / (2 * mu);
    const auto entry = [&](int i, int j) {
      return (r[i] * s[j] + s[i] * r[j]) / (2 * g) - lambda - (i == j ? 2 * mu : 0);
    };
    const Vec3<double> values = eigen_symmetric(Sym3<double>{entry(0, 0), entry(0, 1), entry(0, 2),
                                                             entry(1, 1), entry(1, 2), entry(2, 2)})
                                    .values;
    most = std::max({most, values[0], values[1], values[2]});
  }
  return most;
}

/// Part of the flow by which softening of cohesion multiplies itself: rho = -(df/dkappa)
/// (dkappa/dgamma)/(N C M), with dkappa/dgamma = sqrt(2/3) |dev M| <= 4/3 and N C M >= 4 mu; and
/// the same per unit of |t_1 + t_3|/2 for friction.
struct SofteningRates {
  double cohesion, friction;
  explicit SofteningRates(const MohrCoulomb::Input& in) {
    const LameConstants lame = lame_constants(in.youngs_modulus, in.poissons_ratio);
    const MohrCoulombRange range(in);
    const double per_strain = 4.0 / 3.0 / 2 / in.softening_strain;
    const double angle = range.friction[0] - range.friction[1];
    cohesion = per_strain *
               (2 * (range.cohesion[0] - range.cohesion[1]) +
                2 * range.cohesion[0] * std::sin(range.friction[0]) * angle) /
               (2 * lame.mu);
    friction = per_strain * 2 * angle;
  }
};

}  // namespace detail

template <class T>
MohrCoulomb::Params<T> MohrCoulomb::params(const Input& in, double density, int /*dimension*/) {
  const auto [lambda, mu] = lame_constants(in.youngs_modulus, in.poissons_ratio);
  const double ratio = lambda / (2 * mu);
  const detail::MohrCoulombRange range(in);
  const bool cuts = !std::isnan(in.tension_cutoff), softens = !std::isnan(in.softening_strain);
  double flow = 0, growth = 0;
  for (int i = 0; i <= (softens ? 32 : 0); ++i) {
    const double part = i / 32.0;
    flow = std::max(flow,
                    detail::mohr_coulomb_flow_stiffness(lambda, mu, range.at(range.friction, part),
                                                        range.at(range.dilation, part)));
  }
  if (softens) {
    const detail::SofteningRates rates(in);
    const double kept = 1 - std::min(rates.cohesion, detail::largest_softening);
    flow /= kept;
    growth = rates.friction * (1 + 3 * std::abs(ratio)) / kept;
  }
  const auto strength =
      detail::mohr_coulomb_strength(std::sin(in.friction_angle), std::cos(in.friction_angle),
                                    std::sin(in.dilation_angle), in.cohesion / (2 * mu), ratio);
  return {T(lambda),
          T(mu),
          T(density),
          T(ratio),
          strength.template as<T>(),
          cuts,
          T(cuts ? in.tension_cutoff / (2 * mu) : 0),
          softens,
          T(range.friction[0]),
          T(range.friction[0] - range.friction[1]),
          T(range.cohesion[0] / (2 * mu)),
          T((range.cohesion[0] - range.cohesion[1]) / (2 * mu)),
          T(range.dilation[0]),
          T(range.dilation[0] - range.dilation[1]),
          T(softens ? 1 / in.softening_strain : 0),
          T(flow),
          T(growth)};
}

}  // namespace scree

// Last, for it uses what is declared above, whichever of the three headers comes first.
#include "materials/mohr_coulomb_schema.hpp"
