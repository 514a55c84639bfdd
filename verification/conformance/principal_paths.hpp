// SPDX-License-Identifier: Apache-2.0
/// \file
/// Paths of a material point along fixed principal axes, and measures of its stress; shared by the
/// tests of laws against closed forms.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "solver/base/schema.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

/// One step of principal logarithmic strain increments.
template <class M>
Sym3<double> stretch(const typename M::template Params<double>& p,
                     typename M::template State<double>& s, double a, double b, double c) {
  Mat3<double> L = zero3<double>();
  L(0, 0) = std::expm1(a);
  L(1, 1) = std::expm1(b);
  L(2, 2) = std::expm1(c);
  return M::kirchhoff(p, s, L, 1e-3);
}

inline double mean_pressure(const Sym3<double>& tau) { return -trace(tau) / 3; }
/// q = sqrt(3/2) |dev tau|
inline double shear_stress(const Sym3<double>& tau) { return std::sqrt(1.5) * norm(deviator(tau)); }

/// The x in a step for which `error` vanishes, by the secant method to 1e-13 of `scale`; error is a
/// smooth function of x, apart from kinks.
template <class Error>
double solve(double x0, double x1, double scale, Error error) {
  double e0 = error(x0), e1 = error(x1);
  for (int i = 0; i < 60 && std::abs(e1) > 1e-13 * scale && e1 != e0; ++i) {
    const double x = x1 - e1 * (x1 - x0) / (e1 - e0);
    x0 = x1;
    e0 = e1;
    x1 = x;
    e1 = error(x1);
  }
  return x1;
}

/// One step of axial strain at constant lateral Kirchhoff stress (negative in compression).
template <class M>
Sym3<double> triaxial_step(const typename M::template Params<double>& p,
                           typename M::template State<double>& s, double axial, double lateral) {
  const auto error = [&](double x) {
    auto trial = s;
    return stretch<M>(p, trial, axial, x, x).yy - lateral;
  };
  const double x = solve(-0.3 * axial, -0.5 * axial, std::abs(lateral), error);
  return stretch<M>(p, s, axial, x, x);
}

/// One step of simple shear in the plane 1-2 at constant normal Kirchhoff stress on axis 2.
template <class M>
Sym3<double> shear_step(const typename M::template Params<double>& p,
                        typename M::template State<double>& s, double shear, double normal) {
  const auto increment = [&](auto& state, double x) {
    Mat3<double> L = zero3<double>();
    L(0, 1) = shear;
    L(1, 1) = x;
    return M::kirchhoff(p, state, L, 1e-3);
  };
  const double x = solve(0.0, 0.1 * shear, std::abs(normal), [&](double y) {
    auto trial = s;
    return increment(trial, y).yy - normal;
  });
  return increment(s, x);
}

/// What the checks of a law's schema say.
template <class M>
std::vector<Finding> findings(const typename M::Input& input, int dimension = 3) {
  SchemaContext context;
  context.dimension = dimension;
  std::vector<Finding> result;
  const auto schema = M::schema();
  for (const auto& check : schema.checks()) {
    if (auto finding = check.test(&input, context)) result.push_back(*finding);
  }
  return result;
}

}  // namespace scree::testing
