// SPDX-License-Identifier: Apache-2.0
//
// Laterally confined column of height H, base fixed, top free, under its weight.
//
// Static equilibrium of the nominal stress in the material coordinate X (height before loading) is
// dP/dX = rho0 g with P(H) = 0, so P = -rho0 g (H - X) for every law. Confined, J = F_yy and
// J F^-T_yy = 1: the Cauchy stress is sigma_yy = P. The stretch s solves P(s) = P:
//   fixed-corotated  P = (lambda + 2 mu)(s - 1)                 s = 1 + P/M
//   Hencky           P = (lambda + 2 mu) ln(s)/s                s = exp(-W(-P/M)), Lambert's W
//   neo-Hookean      P = mu (s - 1/s) + lambda ln(s)/s          by bisection
// with M = lambda + 2 mu; the displacement is u(X) = integral of (s - 1) from 0 to X.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::self_weight_column {

struct Column {
  std::string model;
  double height, density, gravity;  ///< m, kg/m^3, m/s^2
  double youngs_modulus;            ///< Pa; Poisson's ratio is 0: lambda = 0, 2 mu = E

  /// Vertical Cauchy stress at material height X [Pa].
  double stress(double X) const { return -density * gravity * (height - X); }

  /// Nominal stress of a stretch [Pa].
  double law(double s) const {
    const double E = youngs_modulus;
    if (model == "hencky") return E * std::log(s) / s;
    if (model == "neo_hookean") return E / 2 * (s - 1 / s);
    return E * (s - 1);
  }

  /// Stretch at X: the law inverted by bisection, all of them rise between 1/e and 1.
  double stretch(double X) const {
    double low = std::exp(-1.0), high = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (law(middle) < stress(X) ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  /// Displacement at X [m], by Gauss's rule with three points on 64 intervals (error below 1e-14).
  double displacement(double X) const {
    constexpr int parts = 64;
    const double h = X / parts, a = std::sqrt(0.6) * h / 2;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
      const double middle = (i + 0.5) * h;
      sum += 5 * stretch(middle - a) + 8 * stretch(middle) + 5 * stretch(middle + a) - 18;
    }
    return sum * h / 18;
  }
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const Column exact{run.text("model"), run.number("height"), run.number("density"),
                       run.number("g"), run.number("E")};
    const double spacing = run.number("cell") / run.number("ppd");
    const double top = exact.displacement(exact.height);
    const ParticleFrame end = run.frame();
    const auto stress = end.field("stress"), volume = end.field("volume");
    double error = 0, total = 0, highest = 0;
    std::vector<double> X, measured;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double here = end.X(p)[1];
      error += std::abs(stress(p, 1, 1) - exact.stress(here)) * volume(p);
      total += volume(p);
      X.push_back(here / exact.height);
      measured.push_back(stress(p, 1, 1) / -exact.stress(0));
      if (here < exact.height - spacing) continue;
      const double off = end.x(p)[1] - here - exact.displacement(here);
      highest = std::max(highest, std::abs(off / top));
    }
    out.value("stress error", error / (exact.density * exact.gravity * exact.height * total));
    out.value("settlement error", highest);
    const HistoryRow& last = run.history.back();
    out.value("rest", last.kinetic_energy / last.elastic_energy);
    draw(run, exact, X, measured, out);
  }

 private:
  static void draw(const Run& run, const Column& exact, const std::vector<double>& X,
                   const std::vector<double>& measured, Measured& out) {
    out.figure("Vertical stress", "height before loading, X/H", "sigma/(rho g H)")
        .particles(X, measured)
        .exact({0, 1}, {-1, 0});
    std::vector<double> t, mean;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time / run.number("period"));
      mean.push_back((row.center[1] - run.history.front().center[1]) /
                     exact.displacement(exact.height));
    }
    out.figure("Settling", "time over the period of the lowest mode",
               "of the centre over that of the top")
        .computed(t, mean);
  }
};

}  // namespace scree::verify::cases::self_weight_column
