// SPDX-License-Identifier: Apache-2.0
//
// A block of dry sand, 0.2 m x 0.15 m, released against a smooth wall on a slope of 10 degrees with
// a held base, plane strain. There is no closed form; the reference is an independent material
// point code, Matter (L. Blatny, J. Gaume, "Matter: an open-source MPM solver for granular matter",
// github.com/larsblatny/matter). Its tests hold the foremost particle after 1.4 s at 0.56 m, to
// 0.011 m: quadratic kernel, base held at nodes, Drucker-Prager's law with the volume correction of
// Tampubolon et al. 2017 and (s1 - s3)/2 <= tan(30 deg) (s1 + s3)/2 in the plane.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "verification/suite/front.hpp"
#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::collapse_on_slope {

struct Case {
  /// The toe ends where it is thinner than a cell, so that the front is short by a length like the
  /// cell size, F(n) = F - k/n with n cells in the width. Two runs tell F.
  static void compare(const std::vector<const Run*>& runs, Measured& out) {
    std::vector<double> cells, front;
    for (const Run* run : runs) {
      if (run->text("no_slip") != "node") continue;
      cells.push_back(run->number("cells"));
      front.push_back(front_of_run(*run));
    }
    const std::size_t n = cells.size();
    if (n < 2) return;
    const double whole = cells[n - 1] * front[n - 1] - cells[n - 2] * front[n - 2];
    out.value("front, without cells", whole / (cells[n - 1] - cells[n - 2]), 0.56);
  }

  static void measure(const Run& run, Measured& out) {
    const HistoryRow& last = run.history.back();
    out.value("grains lost", 1 - last.mass / run.history[0].mass);
    out.value("rest",
              last.kinetic_energy / (last.mass * run.number("g") * run.number("height") / 2));
    const double cell = run.number("cell");
    const ParticleFrame end = run.frame();
    std::vector<double> x, left, height;
    for (std::size_t p = 0; p < end.size(); ++p) {
      x.push_back(end.x(p)[0]);
      const std::size_t i = static_cast<std::size_t>(std::max(x.back(), 0.0) / cell);
      while (height.size() <= i) {
        left.push_back((double(left.size()) + 0.5) * cell);
        height.push_back(0);
      }
      height[i] = std::max(height[i], end.x(p)[1]);
    }
    out.value("front", front_of_run(run), 0.56);
    out.value("height", *std::max_element(height.begin(), height.end()));
    out.value("mean place", last.center[0]);
    out.value("front of 99.5 %", front_of(std::move(x)));
    out.figure("Deposit on the slope", "along the slope (m)", "across (m)")
        .computed(left, height)
        .published({0.549, 0.571}, {0, 0}, "foremost particle, another code");
  }

 private:
  static double front_of_run(const Run& run) {
    const ParticleFrame end = run.frame();
    double front = 0;
    for (std::size_t p = 0; p < end.size(); ++p) front = std::max(front, end.x(p)[0]);
    return front;
  }
};

}  // namespace scree::verify::cases::collapse_on_slope
