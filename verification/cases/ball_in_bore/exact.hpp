// SPDX-License-Identifier: Apache-2.0
//
// Section 6.2.2 of M. Liu, X. Wang, M. Li, CK-MPM, ACM TOG 44(4), 2025: a ball falls through a bore
// that is 1.5 cells wider than it on every side. If it does not touch, it falls by g t^2/2.
// Bodies feel each other where particles share a node: along an axis, where their centres are less
// than two cells apart (compact) or three (quadratic). Surfaces 1.5 cells apart are not, with two
// particles a direction, h = dx/2 (2 dx - h; quadratic: 2.5 cells), and in a square bore the
// nearest faces lie along axes. Aslant, in a round bore, nodes are shared from farther away.
#pragma once

#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::ball_in_bore {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double g = run.number("g");
    std::vector<double> t, way, exact;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      double sum = 0, count = 0;
      for (std::size_t p = 0; p < frame.size(); ++p) {
        if (frame.body(p) != 0) continue;
        sum += frame.X(p)[2] - frame.x(p)[2];
        count += 1;
      }
      t.push_back(frame.time());
      way.push_back(sum / count / run.number("cell"));
      exact.push_back(g * frame.time() * frame.time() / 2 / run.number("cell"));
    }
    out.value("fall", way.back() / exact.back(), 1);
    out.figure("Way of the ball", "time (s)", "way (cells)")
        .computed(t, way, run.label)
        .exact(t, exact, "free fall");
  }
};

}  // namespace scree::verify::cases::ball_in_bore
