// SPDX-License-Identifier: Apache-2.0
//
// Collapse of a cylinder of dry grains of radius r0 and aspect ratio a = H/r0 on a rough floor.
// Experiments:
//   G. Lube, H. Huppert, R. Sparks, M. Hallworth, J. Fluid Mech. 508, 2004:
//     (r_inf - r0)/r0 = 1.24 a (a < 1.7), 1.6 a^(1/2);   h_inf/r0 = a (a < 1), 0.88 a^(1/6).
//   E. Lajeunesse, A. Mangeney-Castelnau, J. Vilotte, Phys. Fluids 16, 2004:
//     a (a < 3), (3 a)^(1/2);                            a (a < 0.74), 0.74.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "verification/suite/front.hpp"
#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::granular_collapse_3d {

inline double lube_run_out(double a) { return a < 1.7 ? 1.24 * a : 1.6 * std::sqrt(a); }
inline double lajeunesse_run_out(double a) { return a < 3 ? a : std::sqrt(3 * a); }
inline double lajeunesse_height(double a) { return std::min(a, 0.74); }
inline double lube_height(double a) { return a < 1 ? a : 0.88 * std::pow(a, 1.0 / 6); }

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double a = run.number("aspect"), r0 = run.number("radius"), cell = run.number("cell");
    const ParticleFrame end = run.frame();
    std::vector<double> radii, profile(static_cast<std::size_t>(4 * run.number("cells")), 0.0);
    double along_x = 0, along_y = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double r = std::hypot(end.x(p)[0], end.x(p)[1]);
      radii.push_back(r);
      const std::size_t i = static_cast<std::size_t>(r / cell);
      if (i < profile.size()) {
        profile[i] = std::max(profile[i], end.x(p)[2] + cell / run.number("ppd") / 2);
      }
      along_x += end.x(p)[0];
      along_y += end.x(p)[1];
    }
    const double front = front_of(std::move(radii));
    const double run_out = front / r0 - 1, height = profile[0] / r0;
    out.value("run-out over the shorter law",
              run_out / std::min(lube_run_out(a), lajeunesse_run_out(a)));
    out.value("run-out over the longer law",
              run_out / std::max(lube_run_out(a), lajeunesse_run_out(a)));
    out.value("height over the lower law", height / std::min(lube_height(a), lajeunesse_height(a)));
    out.value("height over the higher law",
              height / std::max(lube_height(a), lajeunesse_height(a)));
    out.value("asymmetry", std::abs(along_x / along_y - 1));
    const HistoryRow& last = run.history.back();
    out.value("rest",
              last.kinetic_energy / (last.mass * run.number("g") * run.number("height") / 2));
    std::vector<double> r, h;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      r.push_back((double(i) + 0.5) * cell / r0);
      h.push_back(profile[i] / r0);
    }
    out.figure("Deposit", "r/r0", "height/r0").computed(r, h);
  }
};

}  // namespace scree::verify::cases::granular_collapse_3d
