// SPDX-License-Identifier: Apache-2.0
//
// Confined bar of a fixed-corotated solid, 0 <= X <= L, a rigid smooth wall at 0: the wave equation
// in the material coordinate, exact at any amplitude (see wave_impact). Stress over that of the
// first front, P/P0, by d'Alembert:
//   a pressure P0 on the end L from t = 0 on: P0 for X > L - c t; at the wall it is doubled and
//     returns, 2 P0 for X < c t - L. The end's displacement is -P0 t/(rho c) until 2 L/c.
//   the bar runs into the wall with v: P0 = rho c v for X < c t; from t = L/c on it unloads,
//     0 for X > 2 L - c t.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::stress_wave {

/// Stress over that of the front [-], compression positive; X over L, t over L/c.
inline double exact_stress(bool pressure, double X, double t) {
  if (pressure) return (X > 1 - t ? 1 : 0) + (X < t - 1 ? 1 : 0);
  return X < t && X < 2 - t ? 1 : 0;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const bool pressure = run.text("kind") == "pressure";
    const double P0 = run.number("strain") * run.number("E");
    const ParticleFrame frame = run.frame();  // t = 1.5 L/c: the reflected front is in the middle
    const double t = frame.time() / run.number("travel");
    const Column stress = frame.field("stress");
    std::vector<double> X, P, exact_X, exact_P;
    double wall = 0, at_wall = 0, end = 0, at_end = 0, error = 0;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      X.push_back(frame.X(p)[0]);
      P.push_back(-stress(p, 0, 0) / P0);
      error += std::abs(P.back() - exact_stress(pressure, X.back(), t));
      if (X.back() < 0.3) {
        wall += P.back();
        at_wall += 1;
      } else if (X.back() > 0.7 && X.back() < 0.9) {
        end += P.back();
        at_end += 1;
      }
    }
    for (int i = 0; i <= 400; ++i) {
      exact_X.push_back(i / 400.0);
      exact_P.push_back(exact_stress(pressure, exact_X.back(), t));
    }
    out.value("stress at the wall", wall / at_wall, exact_stress(pressure, 0.1, t));
    out.value("stress behind", end / at_end, exact_stress(pressure, 0.8, t));
    out.value("stress error", error / double(frame.size()));
    measure_impulse(run, pressure, out);
    out.figure("Stress, " + run.text("kind"), "X/L", "stress over that of the first front")
        .particles(X, P)
        .exact(exact_X, exact_P);
  }

 private:
  /// Mean velocity along the axis over the speed behind a front, from the momentum theorem: the
  /// pressure gives -t until L/c, then the wall bears twice as much, t - 2; the wall alone gives
  /// the bar that arrives with -1 its rebound, t - 1 until L/c and on to 1.
  static void measure_impulse(const Run& run, bool pressure, Measured& out) {
    const double v = run.number("strain") * run.number("c"), travel = run.number("travel");
    std::vector<double> t, mean, exact;
    double largest = 0;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time / travel);
      mean.push_back(row.momentum[0] / (row.mass * v));
      exact.push_back(pressure ? (t.back() < 1 ? -t.back() : t.back() - 2) : t.back() - 1);
      largest = std::max(largest, std::abs(mean.back() - exact.back()));
    }
    out.value("velocity error", largest);
    out.figure("Mean velocity, " + run.text("kind"), "t c/L", "velocity over that behind the front")
        .computed(t, mean)
        .exact(t, exact);
  }
};

}  // namespace scree::verify::cases::stress_wave
