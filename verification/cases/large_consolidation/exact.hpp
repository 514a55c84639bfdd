// SPDX-License-Identifier: Apache-2.0
//
// Consolidation at large strain under self-weight (R. E. Gibson, G. L. England, M. J. L. Hussey,
// Geotechnique 17, 1967). At rest the water is hydrostatic below the surface, where it is drained:
// p = rho_f g (y(H) - y). Above X stand the grains, with their mass rho_s (1 - n0)(H - X), and the
// water that is still there, rho_f n y' dX; grains keep their volume. What is left for the
// effective stress is the buoyant weight of the grains, whatever the deformation:
//   sigma' = -(rho_s - rho_f)(1 - n0) g (H - X) = -(rho - rho_f) g (H - X),
// rho the density of soil and water together at the start. For a fixed-corotated solid with
// Poisson's ratio 0 it is E (s - 1), s = dy/dX: with a = (rho - rho_f) g/E
//   s = 1 - a (H - X),     y = X - a (H X - X^2/2).
// The porosity is n = 1 - (1 - n0)/s, and the water that has flowed out is H - y(H) = a H^2/2.
// Would that water leave its weight behind, the effective stress at the foot would be a seventh too
// large.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::large_consolidation {

struct Column {
  double height, a;  ///< m, 1/m
  double stretch(double X) const { return 1 - a * (height - X); }
  double place(double X) const { return X - a * (height * X - X * X / 2); }
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double height = run.number("height"), weight = 1000 * run.number("g");
    const Column exact{height, weight / run.number("E")};
    const double top = exact.place(height);
    const ParticleFrame end = run.frame();
    const auto p = end.field("pore_pressure"), n = end.field("porosity");
    double place = 0, pressure = 0, pores = 0, pores_exact = 0;
    std::vector<double> X, moved, line, curve;
    for (std::size_t i = 0; i < end.size(); ++i) {
      X.push_back(end.X(i)[1] / height);
      moved.push_back(end.x(i)[1] / height);
      place = std::max(place, std::abs(end.x(i)[1] - exact.place(end.X(i)[1])) / height);
      const double depth = top - exact.place(end.X(i)[1]);
      pressure = std::max(pressure, std::abs(p(i) - weight * depth) / (weight * height));
      pores += n(i) / double(end.size());
      const double s = exact.stretch(end.X(i)[1]);
      pores_exact += (1 - (1 - run.number("porosity")) / s) / double(end.size());
    }
    for (int i = 0; i <= 40; ++i) {
      line.push_back(i / 40.0);
      curve.push_back(exact.place(line.back() * height) / height);
    }
    out.value("place error", place);
    out.value("pressure error", pressure);
    out.value("porosity", pores, pores_exact);
    const HistoryRow& last = run.history.back();
    const double area = 2 * run.number("cell");
    out.value("outflow", last.fluid->outflow / (1000 * area * height), 1 - top / height);
    out.value("water balance", std::abs(last.fluid->error));
    out.value("rest", last.kinetic_energy / last.elastic_energy);
    out.figure("Places at the end", "height before, X/H", "height after, y/H")
        .particles(X, moved)
        .exact(line, curve);
  }
};

}  // namespace scree::verify::cases::large_consolidation
