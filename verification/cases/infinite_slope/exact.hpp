// SPDX-License-Identifier: Apache-2.0
//
// A layer of depth h on a plane inclined by theta, the same everywhere along the slope. Balance
// across and along it gives, at the depth z below the surface,
//   sigma_n = rho g z cos(theta),   tau = rho g z sin(theta)   (at rest).
// With equal normal stresses along and across the slope (K = 1 in plane; where plastic flow without
// dilatancy is coaxial with the stress, it leads there) Mohr-Coulomb's criterion without cohesion,
//   (s1 - s3)/2 = sin(phi) (s1 + s3)/2,   is   tau = sin(phi) sigma_n,
// so the layer stands for tan(theta) < sin(phi); Drucker-Prager with the match "plane_strain",
// M = sqrt(3) sin(phi), is the same in isochoric plane flow.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::infinite_slope {

struct Case {
  static void measure(const Run& run, Measured& out) {
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
