// SPDX-License-Identifier: Apache-2.0
//
// Steady uniform flow of a layer of grains (mu(I) rheology) of depth h down a rough plane inclined
// by theta, P. Jop, Y. Forterre, O. Pouliquen, Nature 441, 2006. Along and across the slope
// tau/p = tan(theta) at every depth, so mu(I) = tan(theta) and
//   I = I_t = i0 (tan(theta) - mu_s)/(mu_2 - tan(theta)) = (du/dy) d/sqrt(p/rho_s).
// With p = phi rho_s g cos(theta) (h - y), the velocity is Bagnold's profile
//   u(y) = 2/3 (I_t/d) sqrt(phi g cos(theta)) (h^1.5 - (h - y)^1.5).
// Deviations of the velocity diffuse with the tangent viscosity d tau/d(du/dy) = p I
// mu'(I)/(du/dy), 0.7 Pa s at 24 deg, a tenth of tau/(du/dy); they decay in 4 rho h^2/(pi^2 0.7 Pa
// s) = 2 s. The layer starts with 0.95 of the profile, so after twice that 0.7 % are left.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::bagnold_flow {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double h = run.number("depth"), rate = run.number("rate");
    const double weight = run.number("density") * run.number("g") * std::cos(run.number("theta"));
    const auto exact = [&](double y) {
      return rate * (std::pow(h, 1.5) - std::pow(std::max(h - y, 0.0), 1.5));
    };
    const ParticleFrame end = run.frame();
    const Column velocity = end.field("velocity"), volume = end.field("volume");
    const Column pressure = end.field("pressure");
    double off = 0, total = 0, weighted = 0, all = 0;
    std::vector<double> y, u, kilopascals;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double here = end.x(p)[1], speed = velocity(p, 0);
      off += (speed - exact(here)) * (speed - exact(here)) * volume(p);
      total += exact(here) * exact(here) * volume(p);
      weighted += std::abs(pressure(p) - weight * (h - here)) * volume(p);
      all += volume(p);
      y.push_back(here);
      u.push_back(speed);
      kilopascals.push_back(pressure(p) / 1e3);
    }
    out.value("velocity error", std::sqrt(off / total));
    out.value("pressure error", weighted / (weight * h * all));
    const std::size_t rows = run.history.size();
    const auto mean = [&](std::size_t i) {
      return run.history[i].momentum[0] / run.history[i].mass;
    };
    out.value("mean velocity", mean(rows - 1), 0.6 * exact(h));
    out.value("change", std::abs(mean(rows - 1) / mean(rows - 1 - rows / 5) - 1));
    std::vector<double> line, profile;
    for (int i = 0; i <= 50; ++i) {
      line.push_back(h * i / 50);
      profile.push_back(exact(line.back()));
    }
    out.figure("Velocity", "height above the plane (m)", "velocity (m/s)")
        .particles(y, u)
        .exact(line, profile);
    out.figure("Pressure", "height above the plane (m)", "pressure (kPa)")
        .particles(y, kilopascals)
        .exact({0, h}, {weight * h / 1e3, 0});
  }
};

}  // namespace scree::verify::cases::bagnold_flow
