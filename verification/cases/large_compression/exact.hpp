// SPDX-License-Identifier: Apache-2.0
//
// The column of the case self_weight_column at large compression: the stress P = -rho0 g (H - X) is
// exact for every law and every strain; fixed-corotated, the stretch at the base is 1 - rho0 g H/E.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verification/cases/self_weight_column/exact.hpp"
#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::large_compression {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const self_weight_column::Column exact{"fixed_corotated", run.number("height"),
                                           run.number("density"), run.number("g"), run.number("E")};
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress"), volume = end.field("volume");
    const double scale = exact.density * exact.gravity * exact.height;
    const double spacing = run.number("cell") / run.number("ppd");
    double error = 0, total = 0, largest = 0, top = 0;
    std::vector<double> X, s;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double here = end.X(p)[1], off = std::abs(stress(p, 1, 1) - exact.stress(here)) / scale;
      error += off * volume(p);
      total += volume(p);
      largest = std::max(largest, off);
      X.push_back(here);
      s.push_back(stress(p, 1, 1) / 1e3);
      if (here < exact.height - spacing) continue;
      const double u = end.x(p)[1] - here - exact.displacement(here);
      top = std::max(top, std::abs(u / exact.displacement(exact.height)));
    }
    out.value("stress error", error / total);
    out.value("largest stress error", largest);
    out.value("settlement error", top);
    out.value("rest", run.history.back().kinetic_energy / run.history.back().elastic_energy);
    out.figure("Vertical stress, base at " + percent(exact.stretch(0)) + " of its height",
               "height before loading (m)", "vertical stress (kPa)")
        .particles(X, s)
        .exact({0, exact.height}, {exact.stress(0) / 1e3, 0});
  }

 private:
  static std::string percent(double share) {
    return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
  }
};

}  // namespace scree::verify::cases::large_compression
