// SPDX-License-Identifier: Apache-2.0
//
// As sliding_block, s = g (sin theta - mu cos theta) t^2/2, on a plane that is turned against the
// grid. The block settles on the plane by a part of a cell; the friction of that settling is mu
// times its impulse, too, so that the closed form needs no correction.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::tilted_block {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double theta = run.number("theta"), mu = run.number("mu"), g = run.number("g");
    const double a = g * (std::sin(theta) - mu * std::cos(theta));
    const HistoryRow& first = run.history.front();
    std::vector<double> t, s, n, exact;
    for (const HistoryRow& row : run.history) {
      const double x = row.center[0] - first.center[0], y = row.center[1] - first.center[1];
      t.push_back(row.time);
      s.push_back(x * std::cos(theta) - y * std::sin(theta));
      n.push_back((x * std::sin(theta) + y * std::cos(theta)) / run.number("cell"));
      exact.push_back(a * row.time * row.time / 2);
    }
    out.value("displacement", s.back(), exact.back());
    out.value("displacement error", std::abs(s.back() / exact.back() - 1));
    out.value("settling", *std::min_element(n.begin(), n.end()));
    out.value("lift", *std::max_element(n.begin(), n.end()));
    const std::string friction = std::to_string(mu).substr(0, 3);
    out.figure("Displacement along the plane, friction " + friction, "time (s)", "displacement (m)")
        .computed(t, s)
        .exact(t, exact);
    out.figure("Distance from the plane, friction " + friction, "time (s)", "change (cells)")
        .computed(t, n);
  }
};

}  // namespace scree::verify::cases::tilted_block
