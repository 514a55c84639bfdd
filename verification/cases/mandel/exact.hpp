// SPDX-License-Identifier: Apache-2.0
//
// Saturated soil, |x| < a and |y| < b, plane strain, between smooth, stiff, impermeable platens
// that get a force of 2 F a unit of thickness at t = 0; x = +-a is drained and free (J. Mandel,
// Geotechnique 3, 1953; A. H.-D. Cheng and E. Detournay, Int. J. Numer. Anal. Methods Geomech. 12,
// 1988).
//
// sigma_xx = 0 everywhere and eps_y is uniform, so with e = div u, M_oed = lambda + 2 G and
// sigma_yy the total stress
//   M_oed e = alpha p + 2 G eps_y,     sigma_yy = 2 G (eps_y/(1 - nu) - alpha p/M_oed),
// and int_0^a sigma_yy dx = -F. The balance of the water leads to, T = c_v t/a^2,
//   p = 2 p0 sum c (cos(b x/a) - cos b) exp(-b^2 T),   c = sin b/(b - sin b cos b),
//   tan b = (1 - nu)/(nu_u - nu) b,                     p0 = F B (1 + nu_u)/(3 a),
// and with <p> the mean over the width
//   eps_y = (1 - nu) (alpha <p>/M_oed - F/(2 G a)),
//   -sigma_yy = F/a + 2 G alpha/M_oed (p - <p>):
// the platen presses hardest in the middle. The run gets this pressure as its load, and starts from
// the uniform state at t = 0+: that its top stays flat and sinks as eps_y says is a result.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::mandel {

struct Specimen {
  double ratio;    ///< (1 - nu)/(nu_u - nu), above 1
  double start;    ///< p0 [Pa]
  int terms = 60;  ///< enough from T = 0.01 on

  /// n-th root, n = 0, 1, ...: in (n pi, n pi + pi/2).
  double root(int n) const {
    double low = n * std::numbers::pi, high = low + std::numbers::pi / 2;
    if (n == 0) low = 1e-3;
    const double sign = n % 2 == 0 ? 1 : -1;
    for (int i = 0; i < 60; ++i) {
      const double b = (low + high) / 2;
      (sign * (std::sin(b) - ratio * b * std::cos(b)) < 0 ? low : high) = b;
    }
    return low;
  }
  /// p at x/a in [0, 1].
  double pressure(double x, double T) const {
    return sum(T, [x](double b) { return std::cos(b * x) - std::cos(b); });
  }
  /// Mean of p over the width.
  double mean(double T) const {
    return T == 0 ? start : sum(T, [](double b) { return std::sin(b) / b - std::cos(b); });
  }

 private:
  template <class Shape>
  double sum(double T, Shape&& shape) const {
    double total = 0;
    for (int n = 0; n < terms; ++n) {
      const double b = root(n), c = std::sin(b) / (b - std::sin(b) * std::cos(b));
      total += 2 * start * c * shape(b) * std::exp(-b * b * T);
    }
    return total;
  }
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double nu = run.number("nu");
    const Specimen exact{(1 - nu) / (run.number("nu_u") - nu), run.number("p0")};
    double roots = 0;
    for (int n = 0; n < 6; ++n) {
      roots = std::max(roots, std::abs(exact.root(n) - run.number("b" + std::to_string(n + 1))));
    }
    out.value("roots of the deck", roots);
    double worst = 0, middle = 0, sides = 0;
    for (const int frame : {1, 5, 10}) {
      const Errors errors = pressures(run, exact, frame, out);
      worst = std::max(worst, errors.square);
      middle = std::max(middle, errors.middle);
      sides = std::max(sides, platen(run, exact, frame));
      if (frame == 1) out.value("rise in the middle", errors.rise, errors.exact_rise);
    }
    out.value("pressure error", worst);
    out.value("error in the middle", middle);
    out.value("settlement error", sides);
    outflow(run, exact, out);
  }

 private:
  struct Errors {
    double square, middle;    ///< over the load; of the mean over x < a/10, over its exact value
    double rise, exact_rise;  ///< the mean over x < a/10, over that at the start
  };

  static Errors pressures(const Run& run, const Specimen& exact, int frame, Measured& out) {
    const double width = run.number("half_width"), load = run.number("force") / width;
    const double T = 0.1 * frame;
    const ParticleFrame now = run.frame(frame);
    const auto pressure = now.field("pore_pressure");
    double square = 0, measured_middle = 0, exact_middle = 0, count = 0;
    std::vector<double> x, measured, line, curve;
    for (std::size_t p = 0; p < now.size(); ++p) {
      x.push_back(now.X(p)[0] / width);
      measured.push_back(pressure(p) / load);
      const double right = exact.pressure(x.back(), T) / load;
      square += (measured.back() - right) * (measured.back() - right);
      if (x.back() > 0.1) continue;
      measured_middle += measured.back();
      exact_middle += right;
      ++count;
    }
    for (int i = 0; i <= 50; ++i) {
      line.push_back(i / 50.0);
      curve.push_back(exact.pressure(line.back(), T) / load);
    }
    const std::string at = frame == 1 ? "0.1" : frame == 5 ? "0.5" : "1";
    out.figure("Pore pressure at T = " + at, "x/a", "p a/F")
        .particles(x, measured)
        .exact(line, curve);
    const double start = count * exact.start / load;
    return {std::sqrt(square / double(now.size())), std::abs(measured_middle / exact_middle - 1),
            measured_middle / start, exact_middle / start};
  }

  /// How far the particles of the uppermost row are from where a stiff platen would have them, root
  /// of the mean square, over the settlement of the platen from the start to the end of all.
  static double platen(const Run& run, const Specimen& exact, int frame) {
    const ParticleFrame now = run.frame(frame);
    const auto moved = now.field("displacement");
    const double share = (1 - run.number("nu")) / run.number("modulus");
    double top = 0, square = 0, count = 0;
    for (std::size_t p = 0; p < now.size(); ++p) top = std::max(top, now.X(p)[1]);
    for (std::size_t p = 0; p < now.size(); ++p) {
      if (now.X(p)[1] < top * (1 - 1e-9)) continue;
      const double strain = share * (exact.mean(0.1 * frame) - exact.start);
      square += std::pow(moved(p, 1) - top * strain, 2);
      ++count;
    }
    return std::sqrt(square / count) / (top * share * exact.start);
  }

  /// Water that left: int (1/M) (p0 - p) + alpha (e0 - e) with M_oed e = alpha p + 2 G eps_y.
  static void outflow(const Run& run, const Specimen& exact, Measured& out) {
    const double modulus = run.number("modulus"), shear = run.number("shear");
    const double fall =
        1 / run.number("M") + (1 + 2 * shear * (1 - run.number("nu")) / modulus) / modulus;
    const double whole =
        1000 * run.number("half_width") * run.number("half_height") * fall * exact.start;
    std::vector<double> T, measured, right;
    double worst = 0;
    for (const HistoryRow& row : run.history) {
      T.push_back(row.time / run.number("unit"));
      measured.push_back(row.fluid->outflow / whole);
      right.push_back(1 - exact.mean(T.back()) / exact.start);
      if (T.back() > 0.1) worst = std::max(worst, std::abs(measured.back() - right.back()));
    }
    out.value("outflow error", worst);
    out.value("water balance", std::abs(run.history.back().fluid->error));
    out.figure("Water that flowed out", "time factor T", "outflow over that in the end")
        .computed(T, measured)
        .exact(T, right);
  }
};

}  // namespace scree::verify::cases::mandel
