// SPDX-License-Identifier: Apache-2.0
//
// Two equal bars (length L, impedance rho c) meet with the closing speed 2 v. From the contact on
// fronts run into both bars with c; behind them the material is at rest under
//   |sigma| = rho c (2 v)/2 = rho c v.
// At t = L/c both bars are compressed and at rest; the fronts come back from the free ends as
// unloading and leave the velocity -v; at t = 2 L/c the bars part with their velocities exchanged.
// So the mean velocity of the left bar falls from v to -v along a straight line, and passes through
// zero at t = L/c. Exact for the nominal stress of the confined fixed-corotated solid in material
// coordinates at any amplitude, c^2 = (lambda + 2 mu)/rho; confined, the Cauchy stress along the
// bar is the nominal one. The bars start where the kernels begin to meet; time counts from L/c
// before the mean velocity passes through zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::wave_impact {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double exact = -run.number("density") * run.number("c") * run.number("speed");
    std::vector<double> t, v;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      t.push_back(frame.time() / run.number("travel"));
      v.push_back(left_velocity(frame) / run.number("speed"));
    }
    const double start = passes(t, v, 0) - 1;
    // From 0.8 to -0.8 of the velocity: 1.6 of the whole change of 2.
    out.value("contact time", (passes(t, v, -0.8) - passes(t, v, 0.8)) * 2 / 1.6, 2);
    out.value("speed lost", 1 + v.back());
    for (double& time : t) time -= start;
    out.figure("Mean velocity of the left bar", "time over L/c", "velocity over the first")
        .computed(t, v)
        .exact({t.front(), 0, 2, t.back()}, {1, 1, -1, -1});
    measure_plateau(run, exact, start, out);
    const HistoryRow& first = run.history.front();
    double drift = 0;
    for (const HistoryRow& row : run.history)
      drift = std::max(drift, std::abs(row.momentum[0] - first.momentum[0]));
    out.value("momentum drift", drift / (first.mass / 2 * run.number("speed")));
  }

 private:
  static double left_velocity(const ParticleFrame& frame) {
    const Column velocity = frame.field("velocity");
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      if (frame.body(p) != 0) continue;
      sum += velocity(p, 0);
      count += 1;
    }
    return sum / count;
  }

  /// Time at which a falling sequence passes a level, by straight lines; NaN if it does not.
  static double passes(const std::vector<double>& t, const std::vector<double>& v, double level) {
    for (std::size_t i = 1; i < v.size(); ++i) {
      if (v[i - 1] > level && v[i] <= level)
        return t[i - 1] + (t[i] - t[i - 1]) * (v[i - 1] - level) / (v[i - 1] - v[i]);
    }
    return std::nan("");
  }

  /// When the fronts stand in the middle of the bars.
  static void measure_plateau(const Run& run, double exact, double start, Measured& out) {
    const int index = static_cast<int>(std::lround((start + 0.5) * 40));
    if (!(index > 0 && index < static_cast<int>(run.frames.size()))) return;
    const ParticleFrame frame = run.frame(index);
    const Column stress = frame.field("stress");
    const double reach = frame.time() * run.number("c") - start, cell = run.number("cell");
    double sum = 0, count = 0, highest = -1e300, front = 0, disturbed = 0;
    std::vector<double> X, s;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      // Distance from the end that meets the other bar.
      const double depth =
          frame.body(p) == 0 ? 1.5 - frame.X(p)[0] : frame.X(p)[0] - 1.5 - run.number("gap");
      const double share = stress(p, 0, 0) / exact;
      X.push_back(frame.body(p) == 0 ? -depth : depth);
      s.push_back(stress(p, 0, 0) / 1e3);
      if (share > 0.5) front = std::max(front, depth);
      if (depth > 0.5 * reach) highest = std::max(highest, share);
      if (depth < 0.5 * reach && std::abs(share - 1) > 0.1) disturbed = std::max(disturbed, depth);
      if (depth > 0.6 * reach || depth < 2 * cell) continue;
      sum += share;
      count += 1;
    }
    out.value("plateau", sum / count, 1.0);
    out.value("overshoot", highest - 1);
    out.value("disturbed length", disturbed);
    out.value("disturbed cells", disturbed / cell);
    out.value("front", (front - reach) / cell);
    out.figure("Stress when the fronts stand in the middle of the bars",
               "distance from the contact in the unloaded bars (m)", "stress (kPa)")
        .particles(X, s)
        .exact({-1, -reach, -reach, reach, reach, 1}, {0, 0, exact / 1e3, exact / 1e3, 0, 0});
  }
};

}  // namespace scree::verify::cases::wave_impact
