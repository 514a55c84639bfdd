// SPDX-License-Identifier: Apache-2.0
//
// Bearing capacity of a rigid strip footing of width B on weightless clay of undrained strength cu,
// L. Prandtl, Nachr. Ges. Wiss. Goettingen 1920: q = (2 + pi) cu, smooth or rough, exact (upper and
// lower bounds meet). Von Mises in plane strain is Tresca with cu = sigma_y/sqrt(3) once plastic
// flow has made the middle stress the mean of the others.
//
// The contact of a body on a grid begins where the footing's nodes feel the soil's: its edge lies
// between a quarter and half a cell farther out than the collider's. The pressure is that over half
// a width of B/2 + 3/8 cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::strip_footing {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double half = run.number("half") + 0.375 * run.number("cell"), cu = run.number("cu");
    const double exact = 2 + std::numbers::pi;
    const double speed = run.number("speed"), push = run.number("push");
    std::vector<double> settlement, factor;
    double sum = 0, count = 0, late = 0, late_count = 0;
    for (const HistoryRow& row : run.history) {
      const double t = row.time;
      const double s = speed * (t < 1 ? t * t / 2 : t - 0.5);  // the speed grows for a second
      settlement.push_back(s / (2 * run.number("half")));
      factor.push_back(row.collider_force_torque[0][1] / (half * cu));
      if (s > 0.5 * push && s <= 0.75 * push) sum += factor.back(), count += 1;
      if (s > 0.75 * push) late += factor.back(), late_count += 1;
    }
    out.value("bearing factor", sum / count, exact);
    out.value("plateau", (late / late_count) / (sum / count) - 1);
    const ParticleFrame end = run.frame();
    const Column pressure = end.field("pressure");
    out.value("pressure noise", noise(run, end, pressure) / cu);
    out.figure("Load and settlement", "settlement/B", "q/cu")
        .computed(settlement, factor)
        .exact({0, settlement.back()}, {exact, exact}, "2 + pi");
  }

 private:
  /// Root mean square difference of the pressure of neighbouring particles of a row (locking shows
  /// as a checkerboard of pressures), in the quarter of the ground below the footing [Pa].
  static double noise(const Run& run, const ParticleFrame& end, const Column& pressure) {
    const double spacing = run.number("cell") / run.number("ppd");
    double squares = 0, count = 0;
    for (std::size_t p = 1; p < end.size(); ++p) {
      const auto& here = end.X(p);
      const auto& last = end.X(p - 1);
      if (here[0] > run.number("half") || here[1] < run.number("depth") - run.number("half"))
        continue;
      if (std::abs(std::hypot(here[0] - last[0], here[1] - last[1]) - spacing) > 0.01 * spacing)
        continue;
      const double off = pressure(p) - pressure(p - 1);
      squares += off * off;
      count += 1;
    }
    return std::sqrt(squares / std::max(count, 1.0));
  }
};

}  // namespace scree::verify::cases::strip_footing
