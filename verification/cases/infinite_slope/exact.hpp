// SPDX-License-Identifier: Apache-2.0
//
// A layer of depth h on a plane inclined by theta, the same everywhere along the slope. Balance
// across and along it gives, at the depth z below the surface,
//   sigma_n = rho g z cos(theta),   tau = rho g z sin(theta)   (at rest).
// With equal normal stresses along and across the slope (K = 1 in plane; where plastic flow without
// dilatancy is coaxial with the stress, it leads there) Mohr-Coulomb's criterion without cohesion,
//   (s1 - s3)/2 = sin(phi) (s1 + s3)/2,   is   tau = sin(phi) sigma_n,
// so the layer stands for tan(theta) < sin(phi) and else slides as one with
//   a = g (sin(theta) - sin(phi) cos(theta)).
// Drucker-Prager with the match "plane_strain", M = sqrt(3) sin(phi), is the same in isochoric
// plane flow (A. Drescher, Analytical methods in bin-load analysis, 1991, for the coaxial simple
// shear; W. F. Chen, Limit analysis and soil plasticity, 1975, for the slope).
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
    const double theta = run.number("theta"), g = run.number("g");
    const double phi = run.number("phi") * std::numbers::pi / 180;
    const double a = g * (std::sin(theta) - std::sin(phi) * std::cos(theta));
    if (a > 0) {
      measure_flow(run, a, out);
    } else {
      measure_rest(run, out);
    }
  }

 private:
  /// The slope of the mean velocity in the last two thirds of the observation, by least squares.
  static void measure_flow(const Run& run, double a, Measured& out) {
    const double start = run.history.back().time - run.number("flow") * 2 / 3;
    double n = 0, t1 = 0, t2 = 0, v1 = 0, tv = 0;
    std::vector<double> t, v;
    for (const HistoryRow& row : run.history) {
      const double speed = row.momentum[0] / row.mass;
      t.push_back(row.time);
      v.push_back(speed);
      if (row.time < start) continue;
      n += 1;
      t1 += row.time;
      t2 += row.time * row.time;
      v1 += speed;
      tv += row.time * speed;
    }
    const double slope = (n * tv - t1 * v1) / (n * t2 - t1 * t1);
    out.value("acceleration", slope, a);
    const double end = t.back(), last = v.back();
    out.figure("Mean velocity down the slope", "time (s)", "velocity (m/s)")
        .computed(t, v)
        .exact({start, end}, {last - a * (end - start), last});
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
