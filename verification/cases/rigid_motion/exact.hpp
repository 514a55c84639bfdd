// SPDX-License-Identifier: Apache-2.0
//
// A body that moves rigidly stays as it is.
//  fall   symplectic Euler sums v_n = g n dt, x_n = x_0 + g dt^2 n (n + 1)/2 exactly.
//  drift  x = x_0 + v t at every particle.
//  spin   L is constant. The centrifugal load stretches the square by about rho omega^2 r^2/(2 E)
//  and
//         the square, which starts without that stretch, vibrates about it: the kinetic energy
//         swings by the elastic energy, its mean must stay.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::rigid_motion {

/// Position after n steps dt of symplectic Euler from rest at the origin.
inline double symplectic_euler_fall(double n, double dt, double g) {
  return g * dt * dt * n * (n + 1) / 2;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const std::string& kind = run.text("kind");
    if (kind == "spin") {
      measure_spin(run, out);
    } else {
      measure_shift(run, kind == "fall", out);
    }
  }

 private:
  static void measure_shift(const Run& run, bool falls, Measured& out) {
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress");
    const double t = end.time(), cell = run.number("cell");
    Vec3<double> shift{{3.7 * t, 2.1 * t, 0}};
    if (falls)
      shift = {
          {0, symplectic_euler_fall(static_cast<double>(run.steps), run.number("step"), -9.81), 0}};
    double off = 0, largest = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      off = std::max(off, norm(end.x(p) - end.X(p) - shift));
      for (int c = 0; c < 9; ++c) largest = std::max(largest, std::abs(stress(p, c)));
    }
    out.value(falls ? "fall error" : "drift error", off / cell);
    out.value("stress", largest / run.number("E"));
  }

  static void measure_spin(const Run& run, Measured& out) {
    const double start = about_centre(run.history.front());
    double drift = 0;
    std::vector<double> t, energy;
    for (const HistoryRow& row : run.history) {
      drift = std::max(drift, std::abs(about_centre(row) / start - 1));
      t.push_back(row.time);
      energy.push_back((row.kinetic_energy + row.elastic_energy) /
                       run.history.front().kinetic_energy);
    }
    out.value("angular momentum drift", drift);
    out.value("energy after a turn", energy.back());
    double growth = 0;
    const ParticleFrame end = run.frame();
    const Vec3<double> middle{{run.number("middle"), run.number("middle"), 0}};
    for (std::size_t p = 0; p < end.size(); ++p)
      growth = std::max(growth, norm(end.x(p) - middle) / norm(end.X(p) - middle) - 1);
    out.value("growth of radii", growth);
    out.figure("Energy of the spinning square", "turns", "kinetic and elastic over the first")
        .computed(t, energy)
        .exact({0, 1}, {1, 1});
  }

  /// Angular momentum about the centre of mass.
  static double about_centre(const HistoryRow& row) {
    return row.angular_momentum[2] -
           (row.center[0] * row.momentum[1] - row.center[1] * row.momentum[0]);
  }
};

}  // namespace scree::verify::cases::rigid_motion
