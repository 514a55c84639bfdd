// SPDX-License-Identifier: Apache-2.0
//
// A standing wave in a confined elastic bar keeps its energy (see the case bar_vibration for the
// closed form). What a transfer loses in one period is its numerical diffusion: pic filters the
// velocity in every step by the kernel, so the loss grows with the number of steps; the affine
// transfers lose what is not linear within a particle's support.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::numerical_diffusion {

struct Case {
  static void measure(const Run& run, Measured& out) {
    std::vector<double> t, energy;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time / run.number("period"));
      energy.push_back((row.kinetic_energy + row.elastic_energy) /
                       run.history.front().kinetic_energy);
    }
    // -ln of what is left: independent of how many periods are looked at.
    out.value("loss", -std::log(energy.back()));
    out.value("energy left", energy.back());
    out.figure("Energy over one period", "time over period", "kinetic and elastic, over the first")
        .computed(t, energy)
        .exact({0, 1}, {1, 1});
  }
};

}  // namespace scree::verify::cases::numerical_diffusion
