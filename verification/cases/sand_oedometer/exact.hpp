// SPDX-License-Identifier: Apache-2.0
//
// Oedometer of sand, Drucker-Prager with isochoric flow, q = M p, M = 6 sin(phi)/(3 - sin(phi)), on
// Hencky's elasticity. The trace of the logarithmic strain is elastic, so the Kirchhoff pressure is
// -K ln J. Elastic confined compression has q/p = 3 (1 - 2 nu)/(1 + nu); if that exceeds M, the
// sand yields from the start, and with q = M p
//   sigma_1 = (1 + 2 M/3) (-K ln J)/J,   sigma_3 = (1 - M/3) (-K ln J)/J,
//   K0 = sigma_3/sigma_1 = (3 - M)/(3 + 2 M).
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::sand_oedometer {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double s = std::sin(run.number("phi") * std::numbers::pi / 180), M = 6 * s / (3 - s);
    const double K = run.number("E") / (3 * (1 - 2 * run.number("nu")));
    const auto exact = [&](double J) { return (1 + 2 * M / 3) * -K * std::log(J) / J; };
    std::vector<double> strain, stress, line, sigma;
    for (const ElementRow& row : run.element->rows) {
      strain.push_back(row.strain.axial);
      stress.push_back(-row.cauchy.xx / 1e3);
    }
    for (int i = 0; i <= 50; ++i) {
      line.push_back(-std::log(run.number("J")) * i / 50);
      sigma.push_back(exact(std::exp(-line.back())) / 1e3);
    }
    const ElementRow& last = run.element->rows.back();
    out.value("axial stress", -last.cauchy.xx, exact(run.number("J")));
    out.value("K0", last.cauchy.yy / last.cauchy.xx, (3 - M) / (3 + 2 * M));
    out.figure("Compression", "logarithmic strain", "axial stress (kPa)")
        .computed(strain, stress)
        .exact(line, sigma);
  }
};

}  // namespace scree::verify::cases::sand_oedometer
