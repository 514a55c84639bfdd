// SPDX-License-Identifier: Apache-2.0
//
// A confined bar of length L is pressed to the stretch s from its end. Slowly, the stress is the
// same everywhere: the nominal stress of the fixed-corotated solid is P = (lambda + 2 mu)(s - 1),
// and confined the Cauchy stress along the bar equals it. The work of the piston is (lambda + 2
// mu)(s - 1)^2/2 a volume at rest. Poisson's ratio is 0: lambda + 2 mu = E.
//
// How slowly: with the speed V sin^2(pi t/T) of the piston the waves that it sends out,
// (V pi/T) (L/c) of the speed c, are 1e-3 of c, and the stress of a strain of 1e-3 is 2e-3 of that
// at s = 1/2.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::piston {

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double E = run.number("E"), cell = run.number("cell");
    const double exact = -E / 2;
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress"), volume = end.field("volume");
    double sum = 0, total = 0;
    std::vector<double> X, s;
    for (std::size_t p = 0; p < end.size(); ++p) {
      sum += stress(p, 0, 0) * volume(p);
      total += volume(p);
      X.push_back(end.X(p)[0]);
      s.push_back(stress(p, 0, 0) / E);
    }
    const double mean = sum / total;
    double square = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      square += (stress(p, 0, 0) - mean) * (stress(p, 0, 0) - mean) * volume(p);
    }
    out.value("stress", mean, exact);
    out.value("scatter", std::sqrt(square / total) / -exact);
    const HistoryRow& last = run.history.back();
    const double stored = last.kinetic_energy + last.elastic_energy;
    out.value("energy balance", last.collider_work.at(0) / stored - 1);
    out.value("work", last.collider_work.at(0) / (2 * cell), E / 8);
    out.figure("Stress at half the length", "place before loading (m)", "stress over E")
        .particles(X, s)
        .exact({0, 1}, {-0.5, -0.5});
    draw_force(run, out);
  }

 private:
  /// Force on the piston against its way.
  static void draw_force(const Run& run, Measured& out) {
    constexpr double pi = 3.14159265358979323846;
    const double end = run.number("end"), fastest = run.number("fastest");
    std::vector<double> way, force;
    for (const HistoryRow& row : run.history) {
      const double t = row.time;
      way.push_back(fastest * (t / 2 - std::sin(2 * pi * t / end) * end / (4 * pi)));
      force.push_back(row.collider_force_torque.at(0)[0] /
                      (2 * run.number("cell") * run.number("E")));
    }
    out.figure("Force on the piston", "way (m)", "force over E A")
        .computed(way, force)
        .exact({0, 0.5}, {0, 0.5});
  }
};

}  // namespace scree::verify::cases::piston
