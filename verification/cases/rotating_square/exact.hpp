// SPDX-License-Identifier: Apache-2.0
//
// A square of side a turns with omega about its centre: kinetic energy rho a^4 omega^2/12 (per
// metre of thickness), angular momentum rho a^4 omega/6, both with the angular velocity omega. Free
// of forces both total energy and angular momentum are constant. The centrifugal load, put on
// suddenly, stretches the square by at most rho omega^2 a^2/(2 E), 0.5 % here: it swings, and the
// energy moves between kinetic and elastic.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::rotating_square {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const HistoryRow& start = run.history.front();
    // The particles' velocities at their places: less than the continuum's by the part within a
    // particle, (spacing/a)^2.
    const double spacing = run.number("spacing");
    out.value("kinetic energy at the start", start.kinetic_energy,
              run.number("density") / 12 * (1 - spacing * spacing));
    const double L0 = spin(start);
    double drift = 0, gained = 0;
    std::vector<double> t, lost;
    for (const HistoryRow& row : run.history) {
      drift = std::max(drift, std::abs(spin(row) / L0 - 1));
      t.push_back(row.time);
      lost.push_back(1 - (row.kinetic_energy + row.elastic_energy) / start.kinetic_energy);
      gained = std::max(gained, -lost.back());
    }
    out.value("energy lost", lost.back());
    out.value("energy gained", gained);
    out.value("angular momentum drift", drift);
    out.figure("Energy lost", "time (s)", "1 - E/E(0)").computed(t, lost).exact({0, 20}, {0, 0});
  }

 private:
  /// Angular momentum about the centre of mass.
  static double spin(const HistoryRow& row) {
    return row.angular_momentum[2] -
           (row.center[0] * row.momentum[1] - row.center[1] * row.momentum[0]);
  }
};

}  // namespace scree::verify::cases::rotating_square
