// SPDX-License-Identifier: Apache-2.0
//
// Consolidation at large strain (R. E. Gibson, G. L. England, M. J. L. Hussey, Geotechnique 17,
// 1967, is the theory). In the end the water carries nothing: in the confined column of a
// fixed-corotated solid with Poisson's ratio 0 the nominal stress is E (s - 1) = -q, so the stretch
// is s = 1 - q/E everywhere, and grains that keep their volume leave the porosity n = 1 - (1 -
// n0)/s. The water that has flowed out is (1 - s) of the volume at the start.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::large_consolidation {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double height = run.number("height"), stretch = 1 - run.number("strain");
    const double porosity = 1 - (1 - run.number("porosity")) / stretch;
    const ParticleFrame end = run.frame();
    const auto p = end.field("pore_pressure"), n = end.field("porosity");
    double place = 0, pressure = 0, pores = 0;
    for (std::size_t i = 0; i < end.size(); ++i) {
      place = std::max(place, std::abs(end.x(i)[1] - stretch * end.X(i)[1]) / height);
      pressure = std::max(pressure, std::abs(p(i)) / run.number("load"));
      pores += n(i) / double(end.size());
    }
    out.value("place error", place);
    out.value("pressure left", pressure);
    out.value("porosity", pores, porosity);
    const HistoryRow& last = run.history.back();
    const double area = 2 * run.number("cell");
    out.value("outflow", last.fluid->outflow / (1000 * area * height), 1 - stretch);
    out.value("water balance", std::abs(last.fluid->error));
    out.value("rest", last.kinetic_energy / last.elastic_energy);
    std::vector<double> T, settled;
    for (const HistoryRow& row : run.history) {
      T.push_back(row.time / run.number("unit"));
      settled.push_back(2 * (row.center[1] - run.history.front().center[1]) / height);
    }
    out.figure("Twice the settlement of the centre", "time factor T_v", "over the height")
        .computed(T, settled);
  }
};

}  // namespace scree::verify::cases::large_consolidation
