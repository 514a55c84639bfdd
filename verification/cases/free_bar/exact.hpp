// SPDX-License-Identifier: Apache-2.0
//
// Free vibration of a bar that is held at X = 0 and free at X = L, nu = 0. Stretched along X alone
// the nominal stress of the fixed-corotated solid is P = E (F_xx - 1), at any amplitude, so that
// u_tt = c^2 u_XX, c^2 = E/rho0. From the velocity v0 sin(pi X/(2 L)) at rest in its first shape
//   u = v0/w sin(w t) sin(pi X/(2 L)),   w = pi c/(2 L),
// and the centre of mass moves with v0 2/pi cos(w t). L = 25 m, E = 100 Pa, rho = 1 kg/m^3, v0 =
// 0.1 m/s give w = 0.628319/s and 0.063662 m/s: the bar of the page "Axial vibration of a 1D bar"
// of Learn MPM (geoelements.org), and of others.
//
// Symplectic Euler's velocities lag by half a step, w dt/2 = 0.006 with cells of 1 m and dt = 0.2
// dx/c; an error e of the period is one of 20 pi e in the phase after ten.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::free_bar {

struct Case {
  static void measure(const Run& run, Measured& out) {
    constexpr std::size_t rows_a_period = 32;
    const double period = run.number("period"), v0 = run.number("v0");
    std::vector<double> t, speed, exact, zeros;
    double largest_gain = 0, before = 0;
    for (std::size_t i = 0; i < run.history.size(); ++i) {
      const HistoryRow& row = run.history[i];
      t.push_back(row.time);
      speed.push_back(row.momentum[0] / row.mass);
      exact.push_back(v0 * 2 / std::numbers::pi *
                      std::cos(2 * std::numbers::pi * row.time / period));
      if (i > 0 && speed[i - 1] * speed[i] < 0)
        zeros.push_back(t[i - 1] + (t[i] - t[i - 1]) * speed[i - 1] / (speed[i - 1] - speed[i]));
      if (i % rows_a_period != 0) continue;  // symplectic Euler's energy swings within a period
      const double energy = row.kinetic_energy + row.elastic_energy;
      if (i > 0) largest_gain = std::max(largest_gain, energy / before - 1);
      before = energy;
    }
    // Velocities pass through zero twice a period.
    const double between = (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
    out.value("first mean velocity", speed[0], exact[0]);
    out.value("period error", std::abs(2 * between / period - 1));
    out.value("energy lost", 1 - before / run.history[0].kinetic_energy);
    out.value("energy gained", largest_gain);
    double off = 0;
    for (std::size_t i = 0; i < speed.size(); ++i)
      off = std::max(off, std::abs(speed[i] - exact[i]));
    out.value("velocity error", off / exact[0]);
    out.figure("Velocity of the centre of mass", "time (s)", "velocity (m/s)")
        .computed(t, speed)
        .exact(t, exact);
  }
};

}  // namespace scree::verify::cases::free_bar
