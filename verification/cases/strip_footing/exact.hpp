// SPDX-License-Identifier: Apache-2.0
//
// Rough strip footing of width 2 b on weightless Tresca clay (L. Prandtl, Nachr. Ges. Wiss.
// Goettingen, 1920; R. Hill, The Mathematical Theory of Plasticity, 1950, chapter IX): a rigid
// wedge of 45 degrees, fans of 90 degrees about the edges and passive wedges, isochoric, give
//   q = (2 + pi) cu,
// exact, since lower and upper bound agree. Mises' clay yields in plane strain at the shear stress
// cu = sigma_y/sqrt(3).
//
// Which width the grid sees. A held node carries its velocity over the integral of its weight,
// one cell: G- nodes at 0 (half of it on this side of the mirror plane), 1, ..., n within the
// footing move a width of (n + 1/2) cells, G+ nodes at 1/2, ..., n - 1/2 one of n cells. Forces are
// the mean of both grids, so a footing whose edge lies anywhere between n and n + 1/2 cells acts as
// one of n + 1/4 cells; of the quadratic kernel's single grid, between n and n + 1, as one of
// n + 1/2. The edge is put just there, with and without fbar: the width needs no correction.
#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::strip_footing {

inline constexpr double prandtl = 2 + 3.14159265358979323846;

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double b = run.number("b"), cu = run.number("cu");
    const double speed = run.number("speed"), ramp = run.number("ramp");
    std::vector<double> settlement, load;
    for (const HistoryRow& row : run.history) {
      const double t = row.time;
      settlement.push_back(1e3 * speed * (t < ramp ? t * t / (2 * ramp) : t - ramp / 2));
      load.push_back(row.collider_force_torque.at(0)[1] / (b * cu));
    }
    out.value("load", load.back(), prandtl);
    // Means, for the load swings by some thousandths; of sixths of the time, for the plateau is
    // reached within two thirds of it.
    const auto sixth = static_cast<std::ptrdiff_t>(load.size() / 6);
    const double last = std::accumulate(load.end() - sixth, load.end(), 0.0);
    const double before = std::accumulate(load.end() - 2 * sixth, load.end() - sixth, 0.0);
    out.value("rise at the end", last / before - 1);
    out.value("pressure scatter", scatter(run) / cu);
    out.figure("Load", "settlement (mm)", "load over cu")
        .computed(settlement, load)
        .exact({0, settlement.back()}, {prandtl, prandtl}, "Prandtl");
  }

 private:
  /// Root mean square of the pressure less its mean over the particle's cell, in the square of the
  /// half width below the footing [Pa].
  static double scatter(const Run& run) {
    const double b = run.number("b"), cell = run.number("cell"), top = run.number("depth");
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress");
    std::map<std::pair<int, int>, std::vector<double>> cells;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double x = end.X(p)[0], y = end.X(p)[1];
      if (x > b || y < top - b) continue;
      cells[{int(std::floor(x / cell)), int(std::floor(y / cell))}].push_back(
          -(stress(p, 0, 0) + stress(p, 1, 1) + stress(p, 2, 2)) / 3);
    }
    double sum = 0, count = 0;
    for (const auto& [place, pressures] : cells) {
      double mean = 0;
      for (const double pressure : pressures) mean += pressure / double(pressures.size());
      for (const double pressure : pressures) sum += (pressure - mean) * (pressure - mean);
      count += double(pressures.size());
    }
    return std::sqrt(sum / count);
  }
};

}  // namespace scree::verify::cases::strip_footing
