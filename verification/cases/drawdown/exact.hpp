// SPDX-License-Identifier: Apache-2.0
//
// Level ground of depth H under water that falls from the depth h to none, gently, in the time t_f:
// h(t) = h/2 (1 + cos(pi t/t_f)). Both the load on the ground and the pressure of the water at its
// surface fall by rho_f g (h - h(t)).
//
// Of a sudden change of the load the water in the pores takes the share s = M/(M + E) at once
// (alpha = 1, E the oedometer's modulus, M = K_f/n); the rest must flow out through the surface.
// With p = rho_f g (h(t) + H - z) + u,
//   u_t = c_v u_zz - (1 - s) rho_f g h'(t),   u(H) = 0, u_z(0) = 0, u(0) = 0,
// so in T = c_v t/H^2, w = pi/T_f, M_n = (n + 1/2) pi
//   u = (1 - s) rho_f g h sum 2 (-1)^n/M_n cos(M_n z/H) a_n,
//   a_n(T) = w/2 (M^2 sin(wT) - w cos(wT) + w exp(-M^2 T))/(M^4 + w^2) until T_f, then decaying
//   with
// exp(-M^2 (T - T_f)). The total stress falls with the load, so the effective stress, tension
// positive, grows by u: not at all if the water is stiff (s = 1). Ground under falling water is as
// firm as before; what fails in a drawdown is a slope, whose shear stresses the water held.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::drawdown {

/// u over rho_f g h at z/H; share: s; fall: T_f.
inline double lag(double z, double T, double fall, double share) {
  const double w = std::numbers::pi / fall, t = std::min(T, fall);
  double sum = 0;
  for (int n = 0; n < 100; ++n) {
    const double M = (n + 0.5) * std::numbers::pi, M2 = M * M;
    const double a = w / 2 * (M2 * std::sin(w * t) - w * std::cos(w * t) + w * std::exp(-M2 * t)) /
                     (M2 * M2 + w * w);
    sum += 2 * (n % 2 == 0 ? 1 : -1) / M * std::cos(M * z) * a * std::exp(-M2 * (T - t));
  }
  return (1 - share) * sum;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double height = run.number("height"), fall = run.number("fall") / run.number("unit");
    const double weight = 1000 * run.number("g"), whole = weight * run.number("above");
    const ParticleFrame start = run.frame(0);
    const auto before = start.field("effective_stress");
    double pressure_error = 0, stress_error = 0;
    for (int frame = 1; frame <= 4; ++frame) {
      const double T = 0.05 * frame;
      const ParticleFrame now = run.frame(frame);
      const auto p = now.field("pore_pressure"), stress = now.field("effective_stress");
      const double level = 0.5 + 0.5 * std::cos(std::numbers::pi * std::min(T / fall, 1.0));
      double pressure = 0, change = 0;
      std::vector<double> z, measured, line, curve;
      for (std::size_t i = 0; i < now.size(); ++i) {
        z.push_back(now.X(i)[1] / height);
        const double u = lag(z.back(), T, fall, run.number("share"));
        measured.push_back((p(i) - weight * (height - now.X(i)[1])) / whole - level);
        pressure += std::pow(measured.back() - u, 2);
        change += std::pow((stress(i, 1, 1) - before(i, 1, 1)) / whole - u, 2);
      }
      for (int i = 0; i <= 40; ++i) {
        line.push_back(i / 40.0);
        curve.push_back(lag(line.back(), T, fall, run.number("share")));
      }
      pressure_error = std::max(pressure_error, std::sqrt(pressure / double(now.size())));
      if (T > fall - 1e-9) {
        stress_error = std::max(stress_error, std::sqrt(change / double(now.size())));
      }
      if (frame % 2 == 1) continue;
      out.figure(frame == 2 ? "What the pores keep when the water has gone, T = 0.1"
                            : "What the pores keep at T = 0.2",
                 "(p - hydrostatic)/(rho_f g h)", "height z/H")
          .particles(measured, z)
          .exact(curve, line);
    }
    out.value("pressure error", pressure_error);
    out.value("effective stress error", stress_error);
    out.value("water balance", std::abs(run.history.back().fluid->error));
  }
};

}  // namespace scree::verify::cases::drawdown
