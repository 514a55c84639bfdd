// SPDX-License-Identifier: Apache-2.0
//
// A rigid disk of radius R on a plane inclined by theta, from rest. With I = m R^2/2 and a contact
// that holds (tan(theta) <= 3 mu) it rolls:
//   a = 2/3 g sin(theta),                 omega = a t/R,
// else it slips:
//   a = g (sin(theta) - mu cos(theta)),   omega = 2 mu g cos(theta) t/R.
// (L. Euler's equations of a rigid body; any textbook of mechanics.)
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::rolling_disk {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double theta = run.number("theta"), mu = run.number("mu"), g = run.number("g");
    const double R = run.number("radius");
    const bool rolls = std::tan(theta) <= 3 * mu;
    const double a =
        rolls ? 2.0 / 3 * g * std::sin(theta) : g * (std::sin(theta) - mu * std::cos(theta));
    const double spin = rolls ? a / R : 2 * mu * g * std::cos(theta) / R;  // 1/s^2
    std::vector<double> t, s, exact;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time);
      s.push_back(row.center[0] - run.history.front().center[0]);
      exact.push_back(a * row.time * row.time / 2);
    }
    out.value("displacement", s.back(), exact.back());
    out.value("angular velocity", -spin_of(run), spin * t.back());
    out.figure("Displacement of the disk", "time (s)", "displacement (m)")
        .computed(t, s)
        .exact(t, exact);
  }

 private:
  /// Angular velocity at the end: sum r x v over sum r^2 about the centre, of equal particles.
  static double spin_of(const Run& run) {
    const ParticleFrame end = run.frame();
    const Column velocity = end.field("velocity");
    const HistoryRow& last = run.history.back();
    double moment = 0, inertia = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double x = end.x(p)[0] - last.center[0], y = end.x(p)[1] - last.center[1];
      moment += x * velocity(p, 1) - y * velocity(p, 0);
      inertia += x * x + y * y;
    }
    return moment / inertia;
  }
};

}  // namespace scree::verify::cases::rolling_disk
