// SPDX-License-Identifier: Apache-2.0
//
// Lowest bending frequency of a cantilever. Euler and Bernoulli: f = (1.8751)^2/(2 pi L^2)
// sqrt(E I/(rho A)), with I/A = h^2/12 (plane strain with nu = 0). Shear and rotary inertia lower
// it by the factor 1 - (k h)^2/24 (1 + E/(kappa G)) n, to first order in (h/L)^2 of Timoshenko's
// beam (kappa = 5/6, G = E/2), where n = 1.3219 is the ratio of the mean squares of the slope and
// of k times the deflection for this mode (it stands for both, since w''(x) = k^2 w(L - x)): 0.66 %
// here. The whole of Timoshenko's equations gives 0.65 %.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::cantilever_vibration {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double h = run.number("height"), k = run.number("k");
    const double slender = k * k * std::sqrt(run.number("E") / run.number("density") / 12) * h;
    const double shear = k * k * h * h / 24 * (1 + 2 / (5.0 / 6)) * 1.3219;
    const double exact = slender / (2 * std::numbers::pi) * (1 - shear);
    std::vector<double> t, u;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      double sum = 0, count = 0;
      for (std::size_t p = 0; p < frame.size(); ++p) {
        if (frame.X(p)[0] < run.number("length") - run.number("cell")) continue;
        sum += frame.x(p)[1] - frame.X(p)[1];
        count += 1;
      }
      t.push_back(frame.time());
      u.push_back(sum / count);
    }
    std::vector<double> zeros;
    for (std::size_t i = 2; i < u.size(); ++i) {
      if (u[i - 1] * u[i] <= 0)
        zeros.push_back(t[i - 1] + (t[i] - t[i - 1]) * u[i - 1] / (u[i - 1] - u[i]));
    }
    const double half = (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
    out.value("frequency", 1 / (2 * half), exact);
    const HistoryRow &first = run.history.front(), &last = run.history.back();
    out.value("energy lost",
              1 - (last.kinetic_energy + last.elastic_energy) / first.kinetic_energy);
    out.figure("Tip of the beam", "time (s)", "displacement (m)").computed(t, u);
  }
};

}  // namespace scree::verify::cases::cantilever_vibration
