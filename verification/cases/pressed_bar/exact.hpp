// SPDX-License-Identifier: Apache-2.0
//
// A confined bar of length L is pressed together by the pressure p on its end. Slowly, the stress
// is -p everywhere: the nominal stress of the fixed-corotated solid is P = (lambda + 2 mu)(s - 1),
// and confined the Cauchy stress along the bar equals it; s = 1 - p/(lambda + 2 mu). The work of
// the pressure is (lambda + 2 mu)(s - 1)^2/2 a volume at rest. Poisson's ratio is 0: lambda + 2 mu
// = E.
//
// How slowly: p = E/2 sin^2(pi t/(2 T)) with T = 50 L/c. Waves that are left have the stress E/4
// (pi/T)^2 (L/c)^2 = 1e-3 E at most, 2e-3 of the last one.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::pressed_bar {

/// Cells from the loaded face within which stresses are those of single, loaded particles.
inline constexpr double loaded_end = 4;

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double E = run.number("E"), cell = run.number("cell");
    const double exact = -E / 2;
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress"), volume = end.field("volume");
    double face = 0;
    for (std::size_t p = 0; p < end.size(); ++p) face = std::max(face, end.x(p)[0]);
    double sum = 0, square = 0, total = 0, disturbed = 0;
    std::vector<double> X, s;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double off = stress(p, 0, 0) / exact - 1, depth = (face - end.x(p)[0]) / cell;
      X.push_back(end.X(p)[0]);
      s.push_back(stress(p, 0, 0) / E);
      if (std::abs(off) > 0.02) disturbed = std::max(disturbed, depth);
      if (depth < loaded_end) continue;
      sum += off * volume(p);
      square += off * off * volume(p);
      total += volume(p);
    }
    const double mean = sum / total;
    out.value("stress", exact * (1 + mean), exact);
    out.value("scatter", std::sqrt(square / total - mean * mean));
    out.value("disturbed cells", disturbed);
    const HistoryRow& last = run.history.back();
    const double stored = last.kinetic_energy + last.elastic_energy;
    const double work = last.external_work.value_or(0);
    out.value("energy balance", work / stored - 1);
    out.value("work", work / (2 * cell), E / 8);
    out.figure("Stress at half the length", "place before loading (m)", "stress over E")
        .particles(X, s)
        .exact({0, 1}, {-0.5, -0.5});
  }
};

}  // namespace scree::verify::cases::pressed_bar
