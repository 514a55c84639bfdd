// SPDX-License-Identifier: Apache-2.0
//
// Saturated soil at rest under gravity, water table at its surface: p = rho_f g (H - y), total
// stress -rho g (H - y), so the effective stress is -(rho - rho_f) g (H - y), that of the buoyant
// weight (K. Terzaghi, Theoretical Soil Mechanics, 1943). Heights are those at the start: the
// column settles by (rho - rho_f) g H^2/(2 E), 5e-4 of its height, where the water carries all at
// first.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::saturated_column {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double height = run.number("height"), water = 1000 * run.number("g") * height;
    const double buoyant = (run.number("density") - 1000) * run.number("g") * height;
    const ParticleFrame end = run.frame();
    const auto p = end.field("pore_pressure"), s = end.field("effective_stress");
    const auto seepage = end.field("seepage_velocity"), volume = end.field("volume");
    double pressure = 0, stress = 0, total = 0, speed = 0;
    std::vector<double> y, measured, effective;
    for (std::size_t i = 0; i < end.size(); ++i) {
      y.push_back(end.X(i)[1] / height);
      measured.push_back(p(i) / water);
      effective.push_back(-s(i, 1, 1) / buoyant);
      const double depth = 1 - y.back();
      pressure = std::max(pressure, std::abs(measured.back() - depth));
      stress += std::abs(effective.back() - depth) * volume(i);
      total += volume(i);
      speed = std::max(speed, std::abs(seepage(i, 1)));
    }
    out.value("pressure error", pressure);
    out.value("effective stress error", stress / total);
    out.value("seepage at the end", speed / (run.number("k") * 1000 * run.number("g")));
    out.value("water balance", std::abs(run.history.back().fluid->error));
    out.figure("Pore pressure", "p/(rho_f g H)", "height y/H")
        .particles(measured, y)
        .exact({1, 0}, {0, 1});
    out.figure("Effective stress", "-s/((rho - rho_f) g H)", "height y/H")
        .particles(effective, y)
        .exact({1, 0}, {0, 1});
  }
};

}  // namespace scree::verify::cases::saturated_column
