// SPDX-License-Identifier: Apache-2.0
//
// Consolidation of a column of height H that drains at its top (Terzaghi), with the inertia of soil
// and water: the run is dynamic, and what is compared must be, too.
//
// Water and grains incompressible, u the displacement, p the pore pressure, z the height:
//   rho u_tt = E u_zz - p_z,      u_t = k p_z,      u(0) = 0,  p(H) = 0,  E u_z(H) = -q,  p = q at
//   t = 0+.
// The deviation of u from its final value -q z/E, over q H/E, is a sum of modes 2 (-1)^n/M_n^2
// a_n(T) sin(M_n z/H) with M_n = (n + 1/2) pi, the time factor T = c_v t/H^2, c_v = k E and epsilon
// = c_v/(c H), c^2 = E/rho. Each amplitude obeys
//   epsilon^2 a'' + a' + M^2 a = 0,   a(0) = 1, a'(0) = 0,
// and p/q = sum -2 (-1)^n/M^3 a_n'(T) cos(M_n z/H). For epsilon -> 0: a' = -M^2 exp(-M^2 T),
// Terzaghi's series (K. Terzaghi, Erdbaumechanik, 1925).
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::terzaghi {

/// p/q at the height z/H in [0, 1] over the impermeable foot.
inline double dynamic_pressure(double z, double T, double epsilon) {
  using Complex = std::complex<double>;
  double sum = 0;
  for (int n = 0; n < 400; ++n) {
    const double M = (n + 0.5) * std::numbers::pi, e = epsilon * epsilon;
    const Complex root = std::sqrt(Complex(1 - 4 * e * M * M));
    const Complex r1 = (-1.0 + root) / (2 * e), r2 = (-1.0 - root) / (2 * e);
    const Complex rate = r1 * r2 * (std::exp(r1 * T) - std::exp(r2 * T)) / (r2 - r1);
    sum -= 2 * (n % 2 == 0 ? 1 : -1) / (M * M * M) * rate.real() * std::cos(M * z);
  }
  return sum;
}

/// Settlement over the final one, without inertia: 1 - sum 2/M^2 exp(-M^2 T).
inline double settlement(double T) {
  double sum = 1;
  for (int n = 0; n < 400; ++n) {
    const double M = (n + 0.5) * std::numbers::pi;
    sum -= 2 / (M * M) * std::exp(-M * M * T);
  }
  return sum;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double load = run.number("load"), height = run.number("height");
    for (const int frame : {1, 5}) {
      const double T = 0.1 * frame;
      const ParticleFrame now = run.frame(frame);
      const auto pressure = now.field("pore_pressure");
      double square = 0;
      std::vector<double> z, measured, line, exact;
      for (std::size_t p = 0; p < now.size(); ++p) {
        z.push_back(now.X(p)[1] / height);
        measured.push_back(pressure(p) / load);
        const double off = measured.back() - dynamic_pressure(z.back(), T, run.number("epsilon"));
        square += off * off;
      }
      for (int i = 0; i <= 50; ++i) {
        line.push_back(i / 50.0);
        exact.push_back(dynamic_pressure(line.back(), T, run.number("epsilon")));
      }
      out.figure(frame == 1 ? "Pore pressure at T_v = 0.1" : "Pore pressure at T_v = 0.5", "p/q",
                 "height z/H")
          .particles(measured, z)
          .exact(exact, line);
      out.value(frame == 1 ? "pressure error at 0.1" : "pressure error at 0.5",
                std::sqrt(square / double(now.size())));
    }
    balance(run, out);
  }

 private:
  /// What flows out is what the top settles: load x height/modulus in the end.
  static void balance(const Run& run, Measured& out) {
    const double height = run.number("height"), width = 2 * run.number("cell");
    const double whole = 1000 * width * run.number("load") * height / run.number("E");
    std::vector<double> T, measured, exact;
    double worst = 0;
    for (const HistoryRow& row : run.history) {
      T.push_back(row.time / run.number("unit"));
      measured.push_back(row.fluid->outflow / whole);
      exact.push_back(settlement(T.back()));
      if (T.back() > 0.1) worst = std::max(worst, std::abs(measured.back() - exact.back()));
    }
    out.value("outflow error", worst);
    out.value("water balance", std::abs(run.history.back().fluid->error));
    out.figure("Water that flowed out", "time factor T_v", "outflow over that in the end")
        .computed(T, measured)
        .exact(T, exact);
  }
};

}  // namespace scree::verify::cases::terzaghi
