// SPDX-License-Identifier: Apache-2.0
//
// A layer of depth h on a plane inclined by theta, the same everywhere along the slope. Balance
// across and along it gives, at the depth z below the surface,
//   sigma_n = rho g z cos(theta),   tau = rho g z sin(theta)   (at rest).
// With equal normal stresses along and across the slope (K = 1 in plane; where plastic flow without
// dilatancy is coaxial with the stress, it leads there) Mohr-Coulomb's criterion without cohesion,
//   (s1 - s3)/2 = sin(phi) (s1 + s3)/2,   is   tau = sin(phi) sigma_n,
// so the layer stands for tan(theta) < sin(phi); Drucker-Prager with the match "plane_strain",
// M = sqrt(3) sin(phi), is the same in isochoric plane flow. Steeper than tan(theta) = tan(phi)
// it flows. With cohesion, tau = c cos(phi) + sin(phi) sigma_n at the base alone, and all above it
// moves as a rigid body with
//   a = g (sin(theta) - sin(phi) cos(theta)) - c cos(phi)/(rho h).
// (Without cohesion tau = sin(phi) sigma_n at every depth: nothing but rounding would keep the
// layer from shearing anywhere.)
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
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
      measure_flow(run, out);
  }

  /// What the layers that the transfers smooth leave of the acceleration falls like the power 3/4
  /// of the cell size; taken away from the two finest runs of each series with apic. (Those with
  /// mls scatter too much between the orders 3/4 and 1.)
  static void compare(const std::vector<const Run*>& runs, Measured& out) {
    struct Finest {
      double cell, a;
    };
    std::map<std::string, std::vector<Finest>> series;
    double exact = 0, worst = -1;
    for (const Run* run : runs) {
      if (run->number("held") == 0 || run->text("transfer") != "apic") continue;
      exact = acceleration(*run);
      series[run->text("model")].push_back({run->number("cell"), mean_acceleration(*run)});
    }
    for (const auto& [model, found] : series) {
      if (found.size() < 2) continue;
      const Finest &coarse = found[found.size() - 2], &fine = found.back();
      const double ratio = std::pow(coarse.cell / fine.cell, 0.75);
      const double a = fine.a + (fine.a - coarse.a) / (ratio - 1);
      worst = std::max(worst, std::abs(a / exact - 1));
    }
    if (worst >= 0) out.value("acceleration error, extrapolated", worst);
  }

 private:
  /// What friction and cohesion at the base take away of the acceleration.
  static double held_back(const Run& run) {
    return run.number("g") * std::sin(run.number("phi") * std::numbers::pi / 180) *
               std::cos(run.number("theta")) +
           run.number("held");
  }
  static double acceleration(const Run& run) {
    return run.number("g") * std::sin(run.number("theta")) - held_back(run);
  }
  /// Over the second half of the time.
  static double mean_acceleration(const Run& run) {
    const HistoryRow &from = run.history[run.history.size() / 2], &to = run.history.back();
    return (to.momentum[0] / to.mass - from.momentum[0] / from.mass) / (to.time - from.time);
  }

  static void measure_flow(const Run& run, Measured& out) {
    const double exact = acceleration(run), a = mean_acceleration(run);
    const double pull = run.number("g") * std::sin(run.number("theta")), ramp = run.number("ramp");
    const double start = ramp * held_back(run) / pull;  // gravity overcomes what holds the layer
    std::vector<double> t, v, line;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time);
      v.push_back(row.momentum[0] / row.mass);
      const double grown = std::clamp(row.time, start, ramp);
      line.push_back(pull / ramp * (grown - start) * (grown - start) / 2 +
                     exact * std::max(0.0, row.time - ramp));
    }
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
