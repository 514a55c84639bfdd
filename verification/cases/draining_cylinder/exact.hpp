// SPDX-License-Identifier: Apache-2.0
//
// Plane strain cylinder of radius a, water and soil: at t = 0 a pressure q acts all round, where p
// = 0 too.
//
// Radial equilibrium, M de/dr = alpha dp/dr with e = div u and M = lambda + 2 mu, gives M e = alpha
// p + f(t). With the storage S the water's balance is S p_t + alpha e_t = k lap p. After Laplace's
// transform, with eta = S + alpha^2/M, c_v = k/eta and b = a sqrt(s/c_v):
//   p = alpha f/(M eta) (I0(b r/a)/I0(b) - 1),
// and sigma_rr(a) = f - 2 mu u(a)/a = -q/s with u(a)/a = (1/a^2) int e r dr gives f. The inverse
// transform is Stehfest's (Commun. ACM 13, 1970). The pressure in the middle first rises above its
// start: the skin that has drained shrinks and squeezes it (N. Mandel 1953, C. W. Cryer 1963;
// cylinders: E. de Leeuw 1965).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::draining_cylinder {

struct Cylinder {
  double modulus, shear, storage;  ///< M, mu [Pa], S [1/Pa]; alpha = 1

  /// Transform of p/q at r/a; s: of the time factor c_v t/a^2.
  double transform(double r, double s) const {
    const double eta = storage + 1 / modulus, b = std::sqrt(s);
    const double I0 = std::cyl_bessel_i(0, b), I1 = std::cyl_bessel_i(1, b);
    const double share = 1 / (modulus * eta);
    // u(a)/a over f, and f over q
    const double u = (0.5 + share * (I1 / (b * I0) - 0.5)) / modulus;
    const double f = -1 / (s * (1 - 2 * shear * u));
    return share * f * (std::cyl_bessel_i(0, b * r) / I0 - 1);
  }

  /// p/q at r/a and the time factor T > 0, to 1e-4.
  double pressure(double r, double T) const {
    constexpr int n = 12;
    const double ln2 = std::numbers::ln2;
    double sum = 0;
    for (int i = 1; i <= n; ++i) sum += weight(i, n) * transform(r, i * ln2 / T);
    return sum * ln2 / T;
  }

 private:
  static double weight(int i, int n) {
    const auto factorial = [](int m) { return std::tgamma(m + 1.0); };
    double sum = 0;
    for (int k = (i + 1) / 2; k <= std::min(i, n / 2); ++k) {
      sum += std::pow(k, n / 2) * factorial(2 * k) /
             (factorial(n / 2 - k) * factorial(k) * factorial(k - 1) * factorial(i - k) *
              factorial(2 * k - i));
    }
    return ((n / 2 + i) % 2 == 0 ? 1 : -1) * sum;
  }
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double E = run.number("E"), nu = run.number("nu"), radius = run.number("radius");
    const Cylinder exact{run.number("modulus"), E / (2 * (1 + nu)),
                         run.number("porosity") / run.number("Kf")};
    double worst = 0, highest = 0;
    for (const int frame : {1, 2, 4, 8}) {
      const double T = 0.05 * frame;
      const ParticleFrame now = run.frame(frame);
      const auto pressure = now.field("pore_pressure");
      double square = 0, middle = 0, count = 0;
      std::vector<double> r, measured, line, curve;
      for (std::size_t p = 0; p < now.size(); ++p) {
        r.push_back(std::hypot(now.X(p)[0], now.X(p)[1]) / radius);
        measured.push_back(pressure(p) / run.number("load"));
        const double off = measured.back() - exact.pressure(std::min(r.back(), 1.0), T);
        square += off * off;
        if (r.back() > 0.15) continue;
        middle += measured.back();
        ++count;
      }
      worst = std::max(worst, std::sqrt(square / double(now.size())));
      highest = std::max(highest, middle / count);
      if (frame == 2 || frame == 8) continue;
      for (int i = 0; i <= 40; ++i) {
        line.push_back(i / 40.0);
        curve.push_back(exact.pressure(line.back(), T));
      }
      out.figure(frame == 1 ? "Pore pressure at T = 0.05" : "Pore pressure at T = 0.2", "r/a",
                 "p/q")
          .particles(r, measured)
          .exact(line, curve);
    }
    out.value("pressure error", worst);
    out.value("highest pressure in the middle", highest, highest_exact(exact));
    out.value("water balance", std::abs(run.history.back().fluid->error));
  }

 private:
  /// Of the times that are measured, mean over r < 0.15.
  static double highest_exact(const Cylinder& exact) {
    double highest = 0;
    for (const double T : {0.05, 0.1, 0.2, 0.4}) {
      double mean = 0;
      for (int i = 0; i < 10; ++i) {
        const double r = 0.15 * (i + 0.5) / 10;
        mean += exact.pressure(r, T) * (2 * i + 1) / 100.0;
      }
      highest = std::max(highest, mean);
    }
    return highest;
  }
};

}  // namespace scree::verify::cases::draining_cylinder
