// SPDX-License-Identifier: Apache-2.0
//
// The jelly of section 6.2 of M. Liu, X. Wang, M. Li, CK-MPM, ACM TOG 44(4), 2025: a cube falls
// from the height d, lands at sqrt(2 d/g) with the energy m g d, and quivers. Undamped, the energy
// is kept and a part of it stays in short waves for ever; numerical diffusion takes these first.
// Koenig's theorem separates them: kinetic energy of the vibration = that of all particles less m
// V^2/2 of the centre of mass.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::falling_jelly {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double g = run.number("g"), drop = run.number("drop");
    const double landing = std::sqrt(2 * drop / g), end = run.history.back().time;
    const double energy = run.history.front().mass * g * drop;
    std::vector<double> t, total, quiver;
    double sum = 0, rows = 0, before = 0, fallen = 0;
    for (const HistoryRow& row : run.history) {
      const double* const P = row.momentum;
      const double centre = (P[0] * P[0] + P[1] * P[1] + P[2] * P[2]) / (2 * row.mass);
      t.push_back(row.time);
      quiver.push_back((row.kinetic_energy - centre) / energy);
      total.push_back((row.kinetic_energy + row.elastic_energy +
                       row.mass * g * (row.center[1] - run.history.front().center[1] + drop)) /
                      energy);
      if (row.time < 0.8 * landing) {
        before = row.kinetic_energy / row.mass * 2;
        fallen = g * row.time;
      }
      if (row.time < landing + 0.3 * (end - landing)) continue;
      sum += quiver.back();
      rows += 1;
    }
    out.value("fall", before, fallen * fallen);
    out.value("energy gained", *std::max_element(total.begin(), total.end()) - 1);
    out.value("energy kept", total.back());
    out.value("vibration", sum / rows);
    out.figure("Kinetic energy of the vibration", "time (s)", "energy over that of the fall")
        .computed(t, quiver);
    out.figure("Kinetic, elastic and potential energy", "time (s)", "energy over that of the fall")
        .computed(t, total)
        .exact({0, end}, {1, 1}, "kept");
  }
};

}  // namespace scree::verify::cases::falling_jelly
