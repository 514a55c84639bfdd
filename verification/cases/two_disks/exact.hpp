// SPDX-License-Identifier: Apache-2.0
//
// Two disks of radius R approach each other along the diagonal with the relative velocity v_rel =
// 2 sqrt(2) v. Exact are
//  - the time of contact, (d - 2 R)/v_rel with the distance d of the centres;
//  - momentum, and the symmetry of the two disks about the centre of the square;
//  - the total energy, as long as nothing damps.
// Through the grid, particles of two bodies act on each other as soon as they share a node: every
// component of their separation is below 2 dx (compact, linear) or 3 dx (quadratic). With the
// particles' spacing h that is early by at most sqrt(2) (2 dx - h)/v_rel, or with 3 dx.
// After D. Sulsky, Z. Chen, H. L. Schreyer, A particle method for history-dependent materials,
// Comput. Methods Appl. Mech. Engrg. 118 (1994) 179, section 4.2.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::two_disks {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double closing = 2 * std::sqrt(2.0) * run.number("speed");
    const double contact = (0.6 * std::sqrt(2.0) - 2 * run.number("radius")) / closing;
    const HistoryRow& start = run.history.front();
    double onset = 0, lowest = 1, highest = 0, drift = 0;
    std::vector<double> t, kinetic, total;
    for (const HistoryRow& row : run.history) {
      const double ratio = row.kinetic_energy / start.kinetic_energy;
      if (onset == 0 && ratio < 0.99) onset = row.time;
      lowest = std::min(lowest, ratio);
      t.push_back(row.time);
      kinetic.push_back(ratio);
      total.push_back(ratio + row.elastic_energy / start.kinetic_energy);
      highest = std::max(highest, total.back());
      drift = std::max(drift, std::hypot(row.momentum[0] - start.momentum[0],
                                         row.momentum[1] - start.momentum[1]));
    }
    const double scale = start.mass / 2 * std::sqrt(2.0) * run.number("speed");
    const double reach = run.text("kernel") == "quadratic" ? 3 : 2;
    const double early =
        std::sqrt(2.0) * (reach - 1 / run.number("ppd")) * run.number("cell") / closing;
    // From 0, the earliest that the kernel allows, to 1, the exact time.
    out.value("contact", (onset - (contact - early)) / early);
    out.value("contact time", onset, contact);
    out.value("kinetic energy left", kinetic.back());
    out.value("lowest kinetic energy", lowest);
    out.value("energy lost", 1 - total.back());
    out.value("energy gained", highest - 1);
    out.value("momentum drift", drift / scale);
    out.value("asymmetry", asymmetry(run));
    out.figure("Kinetic energy", "time (s)", "kinetic energy over the first")
        .computed(t, kinetic)
        .exact({contact, contact}, {0, 1}, "contact of the disks");
    out.figure("Total energy", "time (s)", "kinetic and elastic, over the first")
        .computed(t, total)
        .exact({0, 3.6}, {1, 1});
  }

 private:
  /// Largest distance between a particle and the point image of its twin, over the radius.
  static double asymmetry(const Run& run) {
    const ParticleFrame end = run.frame(), first = run.frame(0);
    const std::size_t half = end.size() / 2;
    double largest = 0;
    for (std::size_t p = 0; p < half; ++p) {
      // Both lattices are filled in the same order, so the twin counts from the other end.
      const std::size_t twin = end.size() - 1 - p;
      double off = 0, before = 0;
      for (int a = 0; a < 2; ++a) {
        off = std::max(off, std::abs(end.x(p)[a] + end.x(twin)[a] - 1));
        before = std::max(before, std::abs(first.x(p)[a] + first.x(twin)[a] - 1));
      }
      if (before < 1e-12) largest = std::max(largest, off);
    }
    return largest / run.number("radius");
  }
};

}  // namespace scree::verify::cases::two_disks
