// SPDX-License-Identifier: Apache-2.0
//
// Manufactured solution along the axes, after Wallstedt and Guilkey, J. Comput. Phys. 227 (2008)
// 9628, section 5: in the unit square
//   u_i(X, t) = A sin(pi X_i) sin(w t + phi_i),   phi = (0, pi),   w = pi sqrt(E/rho0)
// F is diagonal, F_ii = 1 + A pi cos(pi X_i) sin(w t + phi_i). For the neo-Hookean solid
//   P_ii = mu (F_ii - 1/F_ii) + lambda ln J/F_ii,   J = F_xx F_yy (plane strain, F_zz = 1)
// and momentum, rho0 u_tt = dP_ii/dX_i + rho0 b_i, with dF_ii/dX_i = -pi^2 u_i and u_tt = -w^2 u =
// -pi^2 E/rho0 u, needs the body force per mass
//   b_i = pi^2 u_i/rho0 ( (lambda (1 - ln J) + mu)/F_ii^2 + mu - E ),
// which stands in case.toml. The faces do not move: u_i = 0 on X_i = 0 and 1, and no shear acts on
// them, so they are planes of symmetry. In the unit cube (manufactured_solution_3d) phi_z = 0 and
// J = F_xx F_yy F_zz.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::manufactured_solution {

struct Motion {
  double amplitude, frequency;  ///< m, rad/s

  /// Displacement along an axis of the point that was at X along it.
  double displacement(int axis, double X, double t) const {
    const double sign = axis == 1 ? -1 : 1;  // sin(w t + pi) = -sin(w t)
    return sign * amplitude * std::sin(std::numbers::pi * X) * std::sin(frequency * t);
  }
};

/// In D dimensions.
template <int D>
struct MotionCase {
  static void measure(const Run& run, Measured& out) {
    const Motion exact{run.number("A"), run.number("w")};
    double largest = 0;
    std::vector<double> time, error;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      double sum = 0;
      for (std::size_t p = 0; p < frame.size(); ++p) {
        for (int a = 0; a < D; ++a) {
          const double u = frame.x(p)[a] - frame.X(p)[a];
          const double off = u - exact.displacement(a, frame.X(p)[a], frame.time());
          sum += off * off;
        }
      }
      const double norm =
          std::sqrt(sum / (D * static_cast<double>(frame.size()))) / exact.amplitude;
      largest = std::max(largest, norm);
      time.push_back(frame.time() * exact.frequency / (2 * std::numbers::pi));
      error.push_back(norm);
    }
    out.value("displacement error", largest);
    out.figure("Error over one period", "time over period", "root mean square of u - exact, over A")
        .computed(time, error)
        .logarithmic_y();
    draw(run, exact, out);
  }

 private:
  /// Displacements along x where they are largest, a quarter of a period after the start.
  static void draw(const Run& run, const Motion& exact, Measured& out) {
    const ParticleFrame frame = run.frame(static_cast<int>(run.frames.size()) / 4);
    std::vector<double> X, u, line_x, line_u;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      bool beside = false;
      for (int a = 1; a < D; ++a)
        beside = beside || std::abs(frame.X(p)[a] - 0.5) > 0.5 / run.number("cells");
      if (beside) continue;
      X.push_back(frame.X(p)[0]);
      u.push_back((frame.x(p)[0] - frame.X(p)[0]) / exact.amplitude);
    }
    for (int i = 0; i <= 100; ++i) {
      line_x.push_back(i / 100.0);
      line_u.push_back(exact.displacement(0, i / 100.0, frame.time()) / exact.amplitude);
    }
    out.figure("Displacement after a quarter of a period", "X (m)", "u/A")
        .particles(X, u)
        .exact(line_x, line_u);
  }
};

struct Case : MotionCase<2> {};

}  // namespace scree::verify::cases::manufactured_solution
