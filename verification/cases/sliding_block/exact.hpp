// SPDX-License-Identifier: Apache-2.0
//
// A rigid block on a plane inclined by theta with Coulomb's friction mu, from rest: it slides with
//   a = g (sin theta - mu cos theta)
// if mu < tan theta, else it stays. Coulomb, Theorie des machines simples, 1821; any textbook of
// mechanics. Gravity grows over the time T, so that
//   s = a t^3/(6 T) until T,   s = a (T^2/6 + T (t - T)/2 + (t - T)^2/2) after it.
// The block here is elastic: a sudden load makes its weight swing up to twice its mean, and where
// 2 mu > tan theta it then sticks for moments (2e-3 of s with mu = 0.4), which no rigid block does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::sliding_block {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double theta = run.number("theta"), mu = run.number("mu"), g = run.number("g");
    const double a = std::max(g * (std::sin(theta) - mu * std::cos(theta)), 0.0);
    const HistoryRow& first = run.history.front();
    std::vector<double> t, s, exact;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time);
      s.push_back(row.center[0] - first.center[0]);
      const double T = run.number("ramp"), late = std::max(row.time - T, 0.0);
      exact.push_back(a * (std::pow(std::min(row.time, T), 3) / (6 * T) + late * (T + late) / 2));
    }
    if (a > 0) {
      out.value("displacement", s.back(), exact.back());
      out.value("displacement error", std::abs(s.back() / exact.back() - 1));
    } else {
      // From half the time on gravity is whole and the block at rest.
      out.value("creep", std::abs(s.back() - s[s.size() / 2]) / run.number("cell"));
      out.value("elastic shear", s.back() / run.number("cell"));
    }
    out.figure("Displacement along the plane, friction " + short_number(mu), "time (s)",
               "displacement (m)")
        .computed(t, s)
        .exact(t, exact);
  }

 private:
  static std::string short_number(double x) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2g", x);
    return text;
  }
};

}  // namespace scree::verify::cases::sliding_block
