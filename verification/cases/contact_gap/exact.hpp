// SPDX-License-Identifier: Apache-2.0
//
// Particles act on each other through the nodes that they share. Along an axis the kernels reach
//   compact, linear  dx from the particle: no common node where centres are 2 dx apart or more,
//                    always one where they are less than dx apart;
//   quadratic        1.5 dx: none from 3 dx on.
// So the momentum of the left block is exactly what it was, for surface gaps of 2 dx - h (compact;
// h the spacing of particles, half of it on each side) or 3 dx - h (quadratic), whatever the offset
// to the grid: the statement behind section 6.2.2 of M. Liu, X. Wang, M. Li, CK-MPM, ACM TOG 44(4),
// 2025, where a ball falls through a bore that is 1.5 dx wider than it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::contact_gap {

struct Case {
  static void measure(const Run& run, Measured& out) {
    std::vector<double> t, change;
    double largest = 0;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      const Column velocity = frame.field("velocity");
      double sum = 0, count = 0;
      for (std::size_t p = 0; p < frame.size(); ++p) {
        if (frame.body(p) != 0) continue;
        sum += velocity(p, 0) - run.number("drift");
        count += 1;
      }
      t.push_back(frame.time() * run.number("drift") / run.number("cell"));
      change.push_back(sum / count / run.number("apart"));
      largest = std::max(largest, std::abs(change.back()));
    }
    out.value("momentum passed on", largest);
    out.figure("Velocity of the left block", "drift (cells)", "change over the right block's lead")
        .computed(t, change);
  }
};

}  // namespace scree::verify::cases::contact_gap
