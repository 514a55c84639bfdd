// SPDX-License-Identifier: Apache-2.0
//
// A rigid square of side s that slides without friction on its two lower corners inside a circle of
// radius R is a pendulum: its centre moves on a circle of the radius r = sqrt(R^2 - s^2/4) - s/2,
// and it turns with the angle of its place. With the moment of inertia m s^2/6 about the centre,
//   m (1 + s^2/(6 r^2)) v^2/2 = m g d
// where the centre has fallen by d: v = sqrt(2 g r/(1 + s^2/(6 r^2))) at the lowest point, that of
// a point being sqrt(2 g R). From rest at the height of the circle's centre it gets there after a
// quarter of the period of a pendulum that swings by 90 degrees,
//   K(1/sqrt 2) sqrt(r (1 + s^2/(6 r^2))/g),   K(1/sqrt 2) = 1.854075
// (L. D. Landau, E. M. Lifshitz, Mechanics, 11). The force of the wall, up to 3 m g, never pulls.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::circular_slide {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double g = run.number("g"), turning = run.number("turning");
    const std::vector<HistoryRow>& rows = run.history;
    std::size_t low = 0;  // the row of the lowest place
    double arrival = rows.back().time;
    std::vector<double> drop, speed, exact;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].center[1] < rows[low].center[1]) low = i;
      drop.push_back(rows[0].center[1] - rows[i].center[1]);
      speed.push_back(std::hypot(rows[i].momentum[0], rows[i].momentum[1]) / rows[i].mass);
      exact.push_back(std::sqrt(2 * g * std::max(drop[i], 0.0) / turning));
      if (i == 0) continue;
      const double before = rows[i - 1].center[0] - run.number("cx");
      const double after = rows[i].center[0] - run.number("cx");
      if (before < 0 && after >= 0)
        arrival = rows[i].time - (rows[i].time - rows[i - 1].time) * after / (after - before);
    }
    out.value("speed", speed[low], std::sqrt(2 * g * run.number("way") / turning));
    out.value("speed error", std::abs(speed[low] / exact[low] - 1));
    out.value("energy lost", 1 - (rows[low].kinetic_energy + rows[low].elastic_energy) /
                                     (rows[low].mass * g * drop[low]));
    out.value("time error", std::abs(arrival / run.number("quarter") - 1));
    out.figure("Speed of the block", "fall of its centre (m)", "speed (m/s)")
        .computed(drop, speed)
        .exact(drop, exact);
  }
};

}  // namespace scree::verify::cases::circular_slide
