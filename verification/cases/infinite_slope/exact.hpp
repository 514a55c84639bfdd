// SPDX-License-Identifier: Apache-2.0
//
// A layer of depth h on a plane inclined by theta, the same everywhere along the slope. Balance
// across and along it gives, at the depth z below the surface,
//   sigma_n = rho g z cos(theta),   tau = rho g z sin(theta)   (at rest).
// With equal normal stresses along and across the slope (K = 1 in plane; where plastic flow without
// dilatancy is coaxial with the stress, it leads there) Mohr-Coulomb's criterion without cohesion,
//   (s1 - s3)/2 = sin(phi) (s1 + s3)/2,   is   tau = sin(phi) sigma_n,
// so the layer stands for tan(theta) < sin(phi); Drucker-Prager with the match "plane_strain",
// M = sqrt(3) sin(phi), is the same in isochoric plane flow. For tan(theta) > tan(phi) it flows,
// and all of it above the sheared base with
//   a = g (sin(theta) - sin(phi) cos(theta)).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::infinite_slope {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double phi = run.number("phi") * std::numbers::pi / 180;
    if (std::tan(run.number("theta")) < std::sin(phi))
      measure_rest(run, out);
    else
      measure_flow(run, std::sin(phi), out);
  }

 private:
  /// Mean acceleration over the second half of the time.
  static void measure_flow(const Run& run, double friction, Measured& out) {
    const double g = run.number("g"), theta = run.number("theta");
    const double exact = g * (std::sin(theta) - friction * std::cos(theta));
    std::vector<double> t, v, line;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time);
      v.push_back(row.momentum[0] / row.mass);
      // From the time on at which gravity along the slope overcomes friction.
      const double start = run.number("ramp") * friction / std::tan(theta), s = t.back();
      const double grown = std::min(s, run.number("ramp"));
      const double pulled = g * std::sin(theta) / run.number("ramp");
      line.push_back(s < start ? 0
                               : pulled * (grown * grown - start * start) / 2 +
                                     g * std::sin(theta) * (s - grown) -
                                     g * friction * std::cos(theta) * (s - start));
    }
    const std::size_t half = v.size() / 2;
    const double a = (v.back() - v[half]) / (t.back() - t[half]);
    out.value("acceleration", a, exact);
    out.value("acceleration error", std::abs(a / exact - 1));
    double volume = 0;
    const ParticleFrame end = run.frame();
    const Column now = end.field("volume");
    for (std::size_t p = 0; p < end.size(); ++p) volume += now(p);
    out.value("volume", volume / (4 * run.number("cell") * run.number("depth")) - 1);
    out.figure("Mean velocity along the slope", "time (s)", "velocity (m/s)")
        .computed(t, v)
        .exact(t, line);
  }

  static void measure_rest(const Run& run, Measured& out) {
    const double g = run.number("g"), density = run.number("density");
    const double theta = run.number("theta"), depth = run.number("depth");
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress"), volume = end.field("volume");
    const double weight = density * g * depth;
    double normal = 0, shear = 0, total = 0;
    std::vector<double> height, tau;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double z = depth - end.X(p)[1];
      normal += std::abs(stress(p, 1, 1) + density * g * z * std::cos(theta)) * volume(p);
      shear += std::abs(stress(p, 0, 1) - density * g * z * std::sin(theta)) * volume(p);
      total += volume(p);
      height.push_back(end.X(p)[1]);
      tau.push_back(stress(p, 0, 1) / 1e3);
    }
    out.value("normal stress error", normal / (weight * total));
    out.value("shear stress error", shear / (weight * total));
    const double wave = std::sqrt(run.number("E") / density);
    out.value("speed", run.history.back().max_speed / wave);
    out.figure("Shear stress", "height before loading (m)", "shear stress (kPa)")
        .particles(height, tau)
        .exact({0, depth}, {weight * std::sin(theta) / 1e3, 0});
  }
};

}  // namespace scree::verify::cases::infinite_slope
