// SPDX-License-Identifier: Apache-2.0
//
// Without forces from outside momentum is constant and the centre of mass moves uniformly. Two
// equal elastic balls that meet centrally exchange their velocities (Newton), except for what stays
// behind as vibration and is lost to the grid. Test of M. Liu, X. Wang, M. Li, CK-MPM, ACM TOG
// 44(4), 2025, section 6.1.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::linear_momentum {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const HistoryRow& start = run.history.front();
    // Each ball has half of the mass; sqrt(3) speed is its velocity.
    const double scale = start.mass / 2 * std::sqrt(3.0) * run.number("speed");
    double drift = 0, wander = 0;
    std::vector<double> t, error, energy;
    for (const HistoryRow& row : run.history) {
      double momentum = 0, centre = 0;
      for (int a = 0; a < 3; ++a) {
        const double change = row.momentum[a] - start.momentum[a];
        const double off =
            row.center[a] - start.center[a] - start.momentum[a] / row.mass * row.time;
        momentum += change * change;
        centre = std::max(centre, std::abs(off));
      }
      drift = std::max(drift, std::sqrt(momentum) / scale);
      wander = std::max(wander, centre);
      t.push_back(row.time);
      error.push_back(std::sqrt(momentum) / scale);
      energy.push_back(row.kinetic_energy / start.kinetic_energy);
    }
    out.value("momentum drift", drift);
    out.value("centre drift", wander / run.number("cell"));
    out.value("speed lost", 1 + mean_velocity(run) / run.number("speed"));
    out.figure("Momentum lost or gained", "time (s)", "|P - P(0)| over a ball's momentum")
        .computed(t, error)
        .logarithmic_y();
    out.figure("Kinetic energy", "time (s)", "energy over the first").computed(t, energy);
  }

 private:
  /// Of the first ball at the end, mean over the axes.
  static double mean_velocity(const Run& run) {
    const ParticleFrame end = run.frame();
    const Column velocity = end.field("velocity");
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      if (end.body(p) != 0) continue;
      sum += (velocity(p, 0) + velocity(p, 1) + velocity(p, 2)) / 3;
      count += 1;
    }
    return sum / count;
  }
};

}  // namespace scree::verify::cases::linear_momentum
