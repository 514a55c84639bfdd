// SPDX-License-Identifier: Apache-2.0
//
// The solution of the case manufactured_solution in the unit cube, after Wallstedt and Guilkey, J.
// Comput. Phys. 227 (2008) 9628, section 5:
//   u_i(X, t) = A sin(pi X_i) sin(w t + phi_i),   phi = (0, pi, 0),   w = pi sqrt(E/rho0).
// With three stretches J = F_xx F_yy F_zz; else the derivation is that in the square, and so is the
// body force.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::manufactured_solution_3d {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double A = run.number("A"), w = run.number("w");
    double largest = 0;
    std::vector<double> time, error;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      const double now = A * std::sin(w * frame.time());
      double sum = 0;
      for (std::size_t p = 0; p < frame.size(); ++p) {
        for (int a = 0; a < 3; ++a) {
          const double exact = (a == 1 ? -now : now) * std::sin(std::numbers::pi * frame.X(p)[a]);
          const double off = frame.x(p)[a] - frame.X(p)[a] - exact;
          sum += off * off;
        }
      }
      const double norm = std::sqrt(sum / (3 * static_cast<double>(frame.size()))) / A;
      largest = std::max(largest, norm);
      time.push_back(frame.time() * w / (2 * std::numbers::pi));
      error.push_back(norm);
    }
    out.value("displacement error", largest);
    out.figure("Error over one period", "time over period", "root mean square of u - exact, over A")
        .computed(time, error)
        .logarithmic_y();
  }
};

}  // namespace scree::verify::cases::manufactured_solution_3d
