// SPDX-License-Identifier: Apache-2.0
//
// Galilei: in a frame of reference that moves with the velocity V the disks of the case two_disks
// do the same. So the kinetic energy about the centre of mass, sum m |v - V|^2/2, is the same
// function of time whatever V is. Disks and grid differ in where nodes lie; what V changes is the
// error of the grid. (V is not a whole cell a step, so no two steps see the disks at the same
// offset.)
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::moving_frame {

/// Kinetic energy about the moving frame over that at t = 0, at each frame.
inline std::vector<double> relative_energy(const Run& run) {
  const double V[2] = {run.number("vx"), run.number("vy")};
  std::vector<double> energy;
  for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
    const ParticleFrame frame = run.frame(f);
    const Column velocity = frame.field("velocity"), mass = frame.field("mass");
    double sum = 0;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      for (int a = 0; a < 2; ++a) sum += mass(p) * std::pow(velocity(p, a) - V[a], 2) / 2;
    }
    energy.push_back(sum);
  }
  for (std::size_t i = energy.size(); i-- > 0;) energy[i] /= energy[0];
  return energy;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const std::vector<double> energy = relative_energy(run);
    std::vector<double> t;
    for (const ParticleSnapshot& frame : run.frames) t.push_back(frame.time);
    out.value("least energy", *std::min_element(energy.begin(), energy.end()));
    out.figure("Kinetic energy about the moving frame", "time (s)", "over that at the start")
        .computed(t, energy, run.number("moved") > 0 ? "moved along" : "at rest");
  }

  /// Of each kernel and transfer: the run that is moved along against the one that is not.
  static void compare(const std::vector<const Run*>& runs, Measured& out) {
    std::map<std::string, std::vector<double>> still;
    for (const Run* run : runs) {
      const std::string method = run->text("kernel") + " " + run->text("transfer");
      const std::vector<double> energy = relative_energy(*run);
      if (run->number("moved") == 0) {
        still[method] = energy;
        continue;
      }
      double most = 0;
      for (std::size_t i = 0; i < energy.size(); ++i) {
        most = std::max(most, std::abs(energy[i] - still.at(method).at(i)));
      }
      out.value("difference, " + method, most);
    }
  }
};

}  // namespace scree::verify::cases::moving_frame
