// SPDX-License-Identifier: Apache-2.0
//
// Two equal bars (length L, impedance rho c) meet with the closing speed 2 v. From the contact on
// fronts run into both bars with c; behind them the material is at rest under
//   |sigma| = rho c (2 v)/2 = rho c v.
// At t = L/c both bars are compressed and at rest; the fronts come back from the free ends as
// unloading and leave the velocity -v; at t = 2 L/c the bars part with their velocities exchanged.
// Exact for the nominal stress of the confined fixed-corotated solid in material coordinates at any
// amplitude, c^2 = (lambda + 2 mu)/rho; confined, the Cauchy stress along the bar is the nominal
// one.
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
    measure_plateau(run, exact, out);
    measure_rebound(run, out);
    measure_centre(run, exact, out);
  }

 private:
  /// At t = L/(2 c), when the fronts stand in the middle of the bars.
  static void measure_plateau(const Run& run, double exact, Measured& out) {
    const ParticleFrame frame = run.frame(10);
    const Column stress = frame.field("stress");
    const double reach = run.number("c") * frame.time(), cell = run.number("cell");
    double sum = 0, count = 0, highest = 0, front = 0;
    std::vector<double> X, s;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      const double off = std::abs(frame.X(p)[0] - 1.5), share = stress(p, 0, 0) / exact;
      X.push_back(frame.X(p)[0]);
      s.push_back(stress(p, 0, 0) / 1e3);
      highest = std::max(highest, share);
      if (share > 0.5) front = std::max(front, off);
      if (off > 0.6 * reach) continue;
      sum += share;
      count += 1;
    }
    out.value("plateau", sum / count, 1.0);
    out.value("overshoot", highest - 1);
    out.value("front", (front - reach) / cell);
    out.figure("Stress when the fronts stand in the middle of the bars", "X (m)", "stress (kPa)")
        .particles(X, s)
        .exact({0.5, 1.5 - reach, 1.5 - reach, 1.5 + reach, 1.5 + reach, 2.5},
               {0, 0, exact / 1e3, exact / 1e3, 0, 0});
  }

  static void measure_rebound(const Run& run, Measured& out) {
    const ParticleFrame end = run.frame();
    const Column velocity = end.field("velocity");
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      if (end.body(p) != 0) continue;
      sum += velocity(p, 0);
      count += 1;
    }
    out.value("restitution", -sum / count / run.number("speed"));
    const HistoryRow& start = run.history.front();
    double drift = 0;
    for (const HistoryRow& row : run.history)
      drift = std::max(drift, std::abs(row.momentum[0] - start.momentum[0]));
    out.value("momentum drift", drift / (start.mass / 2 * run.number("speed")));
  }

  /// Stress next to the contact over time.
  static void measure_centre(const Run& run, double exact, Measured& out) {
    std::vector<double> t, s;
    double length = 0;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      const Column stress = frame.field("stress");
      double sum = 0, count = 0;
      for (std::size_t p = 0; p < frame.size(); ++p) {
        if (std::abs(frame.X(p)[0] - 1.5) > 0.1) continue;
        sum += stress(p, 0, 0);
        count += 1;
      }
      t.push_back(frame.time() / run.number("travel"));
      s.push_back(sum / count / 1e3);
      if (f > 0) length += (t[t.size() - 1] - t[t.size() - 2]) * sum / count / exact;
    }
    // The impulse of the contact over the plateau: 2 travels less the way of the wave through the
    // strip that is looked at, 0.05 on either end.
    out.value("contact time", length, 2 - 0.1);
    out.figure("Stress at the contact", "time over L/c", "stress (kPa)")
        .computed(t, s)
        .exact({0, 0.1, 1.9, 2.0, 3.0}, {0, exact / 1e3, exact / 1e3, 0, 0});
  }
};

}  // namespace scree::verify::cases::wave_impact
