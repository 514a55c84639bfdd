// SPDX-License-Identifier: Apache-2.0
//
// Angular momentum about the origin is constant without forces from outside. A cylinder (radius R,
// length L along y) with v_x = rate (y - centre) has
//   L_z = - integral rho rate y^2 dV = - rho rate pi R^2 L^3/12,
// all else zero. Test of M. Liu, X. Wang, M. Li, CK-MPM, ACM TOG 44(4), 2025, section 6.1. (The
// paper prints 0.01 for its rod, twice of 4.876e-3: both grids seem to be added without 1/2.)
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::angular_momentum {

/// L_z of the rod [kg m^2/s].
inline double shearing_rod(double density, double rate, double radius, double length) {
  return -density * rate * std::numbers::pi * radius * radius * length * length * length / 12;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double length = run.number("length") * run.number("cell");
    const double exact =
        shearing_rod(run.number("density"), run.number("rate"), length / 8, length);
    const double start = run.history.front().angular_momentum[2];
    double drift = 0, other = 0;
    std::vector<double> t, error;
    for (const HistoryRow& row : run.history) {
      const double* const L = row.angular_momentum;
      const double change = std::abs(L[2] / start - 1);
      drift = std::max(drift, change);
      other = std::max(other, std::hypot(L[0], L[1]) / std::abs(start));
      t.push_back(row.time);
      error.push_back(std::max(change, 1e-17));
    }
    out.value("sampled angular momentum", start, exact);
    out.value("drift", drift);
    out.value("other axes", other);
    out.figure("Angular momentum lost or gained", "time (s)", "|L_z/L_z(0) - 1|")
        .computed(t, error)
        .logarithmic_y();
  }
};

}  // namespace scree::verify::cases::angular_momentum
