// SPDX-License-Identifier: Apache-2.0
//
// Sealed saturated soil in confined compression under a load q (M. A. Biot, J. Appl. Phys. 12,
// 1941; A. W. Skempton, Geotechnique 4, 1954, for the ratio). No water leaves: p = -alpha M e with
// the vertical strain e, and -q = (M_oed + alpha^2 M) e, so
//   p/q = alpha M/(M_oed + alpha^2 M),     effective stress -M_oed q/(M_oed + alpha^2 M),
// M = 1/(n/K_f + (alpha - n)/K_s) the storage modulus, M_oed that of the drained soil.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::skempton {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double alpha = run.number("alpha"), M = run.number("M"), load = run.number("load");
    const double stiff = run.number("modulus") + alpha * alpha * M;
    const double ratio = alpha * M / stiff, effective = -run.number("modulus") / stiff;
    const ParticleFrame end = run.frame();
    const auto p = end.field("pore_pressure"), s = end.field("effective_stress");
    const auto total = end.field("stress"), volume = end.field("volume");
    double pressure = 0, stress = 0, sum = 0, all = 0, spread = 0;
    for (std::size_t i = 0; i < end.size(); ++i) {
      pressure += p(i) * volume(i) / load;
      stress += s(i, 1, 1) * volume(i) / load;
      sum += volume(i);
      all = std::max(all, std::abs(total(i, 1, 1) - (s(i, 1, 1) - alpha * p(i))) / load);
      spread = std::max(spread, std::abs(p(i) / load - ratio));
    }
    out.value("pressure over load", pressure / sum, ratio);
    out.value("effective stress over load", stress / sum, effective);
    out.value("spread of the pressure", spread);
    out.value("total less parts", all);
    out.value("water balance", std::abs(run.history.back().fluid->error));
    out.value("rest", run.history.back().kinetic_energy / run.history.back().elastic_energy);
  }

  /// The share of the water over its stiffness.
  static void compare(const std::vector<const Run*>& runs, Measured& out) {
    if (runs.empty()) return;
    const Run& one = *runs.front();
    const double alpha = one.number("alpha"), n = one.number("porosity");
    std::vector<double> stiffness, share, water, exact;
    for (const Run* run : runs) {
      const ParticleFrame end = run->frame();
      const auto p = end.field("pore_pressure"), volume = end.field("volume");
      double pressure = 0, sum = 0;
      for (std::size_t i = 0; i < end.size(); ++i) {
        pressure += p(i) * volume(i) / run->number("load");
        sum += volume(i);
      }
      stiffness.push_back(run->number("Kf") / 1e6);
      share.push_back(pressure / sum);
    }
    const auto [least, most] = std::minmax_element(stiffness.begin(), stiffness.end());
    for (int i = 0; i <= 60; ++i) {
      water.push_back(*least * std::pow(*most / *least, i / 60.0));
      const double M = 1 / (n / (1e6 * water.back()) + (alpha - n) / one.number("Ks"));
      exact.push_back(alpha * M / (one.number("modulus") + alpha * alpha * M));
    }
    out.figure("Share of the water", "bulk modulus of the water (MPa)", "p/q")
        .particles(stiffness, share, "mean of the particles")
        .exact(water, exact)
        .logarithmic_x();
  }
};

}  // namespace scree::verify::cases::skempton
