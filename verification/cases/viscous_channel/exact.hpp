// SPDX-License-Identifier: Apache-2.0
//
// Steady flow of an incompressible viscous fluid between two walls at the distance h = 1 m, driven
// by gravity g along them (Poiseuille; any textbook of fluid mechanics): nu u'' = -g and no slip,
//   u(y) = g/(2 nu) y (h - y),   mean g h^2/(12 nu).
// Deviations decay as exp(-pi^2 nu t/h^2). With no slip at y = a and y = h - b instead, the mean is
// that of the width h - a - b over h and the centre of the profile lies at (h + a - b)/2; from
// these two follow a and b.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::viscous_channel {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double rate = run.number("g") / run.number("nu");
    const auto exact = [&](double y) { return rate * y * (1 - y) / 2; };
    const ParticleFrame end = run.frame();
    const Column velocity = end.field("velocity"), volume = end.field("volume");
    double off = 0, total = 0, flux = 0, moment = 0, across = 0;
    std::vector<double> y, u;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double here = end.x(p)[1], truth = exact(here);
      off += (velocity(p, 0) - truth) * (velocity(p, 0) - truth) * volume(p);
      total += truth * truth * volume(p);
      flux += velocity(p, 0) * volume(p);
      moment += velocity(p, 0) * here * volume(p);
      across += volume(p);
      y.push_back(here);
      u.push_back(velocity(p, 0));
    }
    out.value("velocity error", std::sqrt(off / total));
    const double both = 1 - std::cbrt(flux / across * 12 / rate);  // a + b
    const double difference = 2 * moment / flux - 1;               // a - b
    out.value("held wall", (both + difference) / 2 / run.number("cell"));
    out.value("friction wall", (both - difference) / 2 / run.number("cell"));
    const auto mean = [](const HistoryRow& row) { return row.momentum[0] / row.mass; };
    const HistoryRow &last = run.history.back(), &before = run.history[run.history.size() - 5];
    out.value("change", std::abs(mean(last) / mean(before) - 1));
    std::vector<double> line, profile;
    for (int i = 0; i <= 50; ++i) {
      line.push_back(i / 50.0);
      profile.push_back(exact(line.back()));
    }
    out.figure("Velocity", "distance from the held wall (m)", "velocity (m/s)")
        .particles(y, u)
        .exact(line, profile);
  }
};

}  // namespace scree::verify::cases::viscous_channel
