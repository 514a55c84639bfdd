// SPDX-License-Identifier: Apache-2.0
//
// A rigid block on a plane inclined by theta with Coulomb's friction mu < tan theta slides, from
// rest, with a = g (sin theta - mu cos theta) (Coulomb, Theorie des machines simples, 1821). Here g
// grows over the time r as g t/r and stays, so that an elastic block hardly swings; then
//   s = a t^3/(6 r) up to r,   s = a (r^2/6 + r (t - r)/2 + (t - r)^2/2) after it.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::oblique_block {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double c = run.number("c"), s = run.number("s"), r = run.number("ramp");
    const double a = run.number("g") * (s - run.number("mu") * c);
    const HistoryRow& first = run.history.front();
    std::vector<double> time, along, exact;
    double off = 0;
    for (const HistoryRow& row : run.history) {
      const double x = row.center[0] - first.center[0], y = row.center[1] - first.center[1];
      const double t = row.time;
      time.push_back(t);
      along.push_back(x * c - y * s);
      off = x * s + y * c;
      exact.push_back(t < r ? a * t * t * t / (6 * r)
                            : a * (r * r / 6 + r * (t - r) / 2 + (t - r) * (t - r) / 2));
    }
    out.value("displacement", along.back(), exact.back());
    out.value("displacement error", std::abs(along.back() / exact.back() - 1));
    out.value("across", off / run.number("cell"));
    out.figure("Displacement along the plane", "time (s)", "displacement (m)")
        .computed(time, along)
        .exact(time, exact);
  }
};

}  // namespace scree::verify::cases::oblique_block
