// SPDX-License-Identifier: Apache-2.0
//
// Galilei: in a frame of reference that moves with the velocity V the disks of the case two_disks
// do the same. So the kinetic energy about the centre of mass, sum m |v - V|^2/2, is the same
// function of time whatever V is.
//
// On a grid the contact of two bodies begins where their particles share nodes: along the diagonal,
// at a distance between 0 and sqrt(2) (r dx - h) of the surfaces, r = 2 (compact) or 3 (quadratic),
// h the spacing, depending on where the nodes lie, and another V is another place. All that follows
// is earlier or later by that distance over the closing speed: an error of first order. Disks that
// vibrate without touching have no such error.
//
// What of the invariance is exact on a grid is that of whole cells: from a start that lies whole
// cells further everything is the same but for rounding, for particles and nodes lie to each other
// as before. With the two lattices of the compact kernel, half a cell apart along all axes, half a
// cell more will do, for they change places, if particles lie half a cell further, too: with an
// even number of them a direction.
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
    out.figure("Kinetic energy about the moving frame", "time (s)", "energy over that at the start")
        .computed(t, energy, run.number("moved") > 0 ? "moved along" : "at rest");
  }

  /// Of each kernel and transfer: the run that is moved along against the one that is not.
  static void compare(const std::vector<const Run*>& runs, Measured& out) {
    std::map<std::string, std::vector<double>> still;
    std::map<std::string, double> coarser;
    std::map<std::string, const Run*> unshifted;
    for (const Run* run : runs) {
      const std::string what =
          run->text("kind") + ", " + run->text("kernel") + " " + run->text("transfer");
      const std::string cells = std::to_string(std::lround(run->number("cells")));
      if (run->number("offset") != 0) {
        compare_places(*run, *unshifted.at(what + " " + cells), what, out);
        continue;
      }
      if (run->number("moved") != 0) unshifted[what + " " + cells] = run;
      const std::vector<double> energy = relative_energy(*run);
      std::vector<double>& other = still[what + " " + cells];
      if (run->number("moved") == 0) {
        other = energy;
        continue;
      }
      double most = 0;
      for (std::size_t i = 0; i < energy.size(); ++i) {
        most = std::max(most, std::abs(energy[i] - other.at(i)));
      }
      out.value(what + ", " + cells + " cells", most);
      if (coarser.count(what) != 0) out.value(what + ", fall", coarser[what] / most);
      coarser[what] = most;
    }
  }

 private:
  /// Every velocity against that of the run that starts elsewhere, over the 0.1 m/s of all disks.
  static void compare_places(const Run& run, const Run& other, const std::string& what,
                             Measured& out) {
    double most = 0;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame here = run.frame(f), there = other.frame(f);
      const Column velocity = here.field("velocity"), expected = there.field("velocity");
      for (std::size_t p = 0; p < here.size(); ++p) {
        for (int a = 0; a < 2; ++a)
          most = std::max(most, std::abs(velocity(p, a) - expected(p, a)));
      }
    }
    out.value(what + (run.number("offset") == 7 ? ", 7 cells" : ", 7.5 cells") + " further",
              most / 0.1);
  }
};

}  // namespace scree::verify::cases::moving_frame
