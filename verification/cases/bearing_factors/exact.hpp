// SPDX-License-Identifier: Apache-2.0
//
// Bearing capacity of a strip footing of width 2 b on cohesionless soil that flows with psi = phi:
//   q_u = q N_q + rho g b N_gamma.
// N_q = exp(pi tan phi) tan^2(45 deg + phi/2) is exact without weight, rough or smooth (L. Prandtl
// 1920, H. Reissner 1924). N_gamma of a rough footing has no closed form; the values here are those
// of the method of characteristics (C. M. Martin, Exact bearing capacity calculations using the
// method of characteristics, Proc. 11th IACMAG, Turin 2005), exact in the theory of plasticity. A
// footing that sinks by s stands below the ground beside it, which adds rho g s N_q.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::bearing_factors {

inline double factor_q(double phi) {
  const double t = std::tan(0.78539816339744831 + phi / 2);
  return std::exp(3.14159265358979323846 * std::tan(phi)) * t * t;
}

/// Of a rough footing; at 20, 25, 30, 35 and 40 degrees.
inline double rough_factor_gamma(double degrees) {
  constexpr double values[] = {2.839, 6.491, 14.75, 34.48, 85.57};
  return values[std::clamp(static_cast<int>(std::lround(degrees / 5)) - 4, 0, 4)];
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double b = run.number("b"), speed = run.number("speed"), ramp = run.number("ramp");
    const double unit = run.number("unit"), Nq = factor_q(run.number("phi"));
    const bool weight = run.text("kind") == "weight";
    std::vector<double> settlement, load, exact;
    for (const HistoryRow& row : run.history) {
      const double t = row.time;
      settlement.push_back(speed * (t < ramp ? t * t / (2 * ramp) : t - ramp / 2) / b);
      load.push_back(row.collider_force_torque.at(0)[1] / (b * unit));
      exact.push_back(weight ? rough_factor_gamma(run.number("degrees")) + Nq * settlement.back()
                             : Nq);
    }
    out.value("load", load.back(), exact.back());
    // What is too much, in cells of soil that would have to lie beside the footing to explain it.
    if (weight) {
      const double excess = load.back() - exact.back();
      out.value("excess", excess / (Nq * run.number("cell") / b));
      out.value("excess load", excess / rough_factor_gamma(run.number("degrees")));
    }
    // Means, for the waves that the footing sends out let its load swing by 2 %, more than once in
    // a quarter of the way.
    const auto quarter = static_cast<std::ptrdiff_t>(load.size() / 4);
    const double last = std::accumulate(load.end() - quarter, load.end(), 0.0);
    const double before = std::accumulate(load.end() - 2 * quarter, load.end() - quarter, 0.0);
    out.value("rise at the end", last / before - 1);
    out.figure(weight ? "Load by the weight" : "Load beside a surcharge",
               "settlement over half width", weight ? "load over rho g b" : "load over surcharge")
        .computed(settlement, load)
        .exact(settlement, exact, weight ? "Martin 2005" : "Prandtl, Reissner");
  }

  /// N_gamma for cells of no size, by the line through the two finest runs of the weight with fbar.
  static void compare(const std::vector<const Run*>& runs, Measured& out) {
    std::vector<double> cells, factors;
    double exact = 0;
    for (const Run* run : runs) {
      if (run->text("kind") != "weight" || run->text("locking") != "fbar") continue;
      const double b = run->number("b"), load = run->history.back().collider_force_torque.at(0)[1];
      factors.push_back(load / (b * run->number("unit")) -
                        factor_q(run->number("phi")) * run->number("sink"));
      cells.push_back(run->number("cell"));
      exact = rough_factor_gamma(run->number("degrees"));
    }
    const std::size_t n = cells.size();
    if (n < 2) return;
    const double slope = (factors[n - 2] - factors[n - 1]) / (cells[n - 2] - cells[n - 1]);
    out.value("N_gamma, extrapolated", factors[n - 1] - slope * cells[n - 1], exact);
  }
};

}  // namespace scree::verify::cases::bearing_factors
