// SPDX-License-Identifier: Apache-2.0
//
// A rigid homogeneous disk on a plane inclined by theta with Coulomb's friction mu, from rest (any
// textbook of mechanics), I = m R^2/2. It rolls if tan(theta) <= 3 mu, with a = 2/3 g sin(theta)
// and alpha = a/R; else it slips, a = g (sin(theta) - mu cos(theta)), alpha = 2 mu g cos(theta)/R.
//
// If the normal force N acts at the distance e ahead of the point of contact, it takes N e from the
// torque of the friction F = m g sin(theta) - m a: I alpha = F R - N e. From a and alpha follows e.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::rolling_disk {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double theta = run.number("theta"), mu = run.number("mu"), g = run.number("g");
    const double R = run.number("radius"), along = g * std::sin(theta);
    const double across = g * std::cos(theta);
    const bool rolls = std::tan(theta) <= 3 * mu;
    const double a = rolls ? 2 * along / 3 : along - mu * across;
    const double alpha = rolls ? a / R : 2 * mu * across / R;
    std::vector<double> t, v, w;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time);
      v.push_back(row.momentum[0] / row.mass);
      w.push_back(-spin(row) / (row.mass * R * R / 2));  // downhill
    }
    // From a quarter of the time on gravity is whole and the disk has settled.
    const std::size_t from = t.size() / 4;
    const double time = t.back() - t[from];
    const double measured_a = (v.back() - v[from]) / time, turns = (w.back() - w[from]) / time;
    out.value("acceleration", measured_a, a);
    out.value("acceleration error", std::abs(measured_a / a - 1));
    out.value("spin error", std::abs(turns / alpha - 1));
    const double friction = along - measured_a;  // over the mass
    out.value("friction", friction / across, rolls ? std::tan(theta) / 3 : mu);
    out.value("offset", (friction * R - R * R / 2 * turns) / across / run.number("cell"));
    std::vector<double> exact;
    for (const double time_now : t) exact.push_back(alpha * (time_now - run.number("ramp") / 2));
    out.figure("Angular velocity", "time (s)", "angular velocity (rad/s)")
        .computed(t, w)
        .exact(t, exact);
  }

 private:
  /// Angular momentum about the centre of mass.
  static double spin(const HistoryRow& row) {
    return row.angular_momentum[2] -
           (row.center[0] * row.momentum[1] - row.center[1] * row.momentum[0]);
  }
};

}  // namespace scree::verify::cases::rolling_disk
