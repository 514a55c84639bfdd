// SPDX-License-Identifier: Apache-2.0
//
// Torsional waves of a round bar. Sections of a circle stay plane and turn by theta(z, t) with
//   theta_tt = c^2 theta_zz,  c^2 = G/rho,
// exact in linear elasticity whatever the radius (A. E. H. Love, Mathematical Theory of Elasticity,
// 1927, article 200; other sections warp). The lowest modes are
//   free ends             theta = -A cos(pi z/L) sin(w t),     w = pi c/L,      turn after L/(2 c)
//   held at 0, free at L  theta =  A sin(pi z/(2 L)) sin(w t), w = pi c/(2 L),  turn after L/c.
// At large angles a neo-Hookean bar keeps this torque, linear in the twist
// (R. S. Rivlin, Phil. Trans. A 241, 1948, for incompressible ones), but wants to become longer.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::twisting_bar {

inline constexpr double pi = 3.14159265358979323846;

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double quarter = run.number("quarter"), A = run.number("degrees") * pi / 180;
    std::vector<double> t, turn, exact;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      t.push_back(frame.time() / quarter);
      turn.push_back(angle(frame, run, turn.empty() ? 0 : turn.back()) / A);
      exact.push_back(std::sin(pi / 2 * t.back()));
    }
    // The turn: the top of the parabola through the largest angle and its neighbours.
    const std::size_t i =
        std::size_t(std::max_element(turn.begin() + 1, turn.end() - 1) - turn.begin());
    const double d1 = (turn[i + 1] - turn[i - 1]) / 2, d2 = turn[i + 1] - 2 * turn[i] + turn[i - 1];
    out.value("largest angle", turn[i] - d1 * d1 / (2 * d2), 1.0);
    const double late = t[i] - d1 / d2 * (t[i + 1] - t[i]) - 1;
    out.value("lateness", late);
    out.value("lateness, spacings",
              late * run.number("radius") / (run.number("cell") / run.number("ppd")));
    double error = 0;
    for (std::size_t k = 0; k < t.size(); ++k) error += std::pow(turn[k] - exact[k], 2);
    out.value("angle error", std::sqrt(2 * error / double(t.size())));
    measure_energy(run, out);
    out.figure("Angle of the end, " + run.text("kind") + ", " +
                   std::to_string(int(run.number("degrees"))) + " deg",
               "time over the quarter period", "angle over the exact amplitude")
        .computed(t, turn)
        .exact(t, exact, "torsional wave");
  }

 private:
  /// Angle by which the last layers of particles have turned [rad], within half a turn of `before`:
  /// the one that the sum of r x (r at the start) has.
  static double angle(const ParticleFrame& frame, const Run& run, double before) {
    const double end =
        run.number("foot") + run.number("length") - 1.01 * run.number("cell") / run.number("ppd");
    double sine = 0, cosine = 0;
    for (std::size_t p = 0; p < frame.size(); ++p) {
      const Vec3<double>&a = frame.X(p), &b = frame.x(p);
      if (a[2] < end) continue;
      sine += a[0] * b[1] - a[1] * b[0];
      cosine += a[0] * b[0] + a[1] * b[1];
    }
    const double angle = std::atan2(sine, cosine);
    return angle +
           2 * pi * std::rint((before * run.number("degrees") * pi / 180 - angle) / (2 * pi));
  }

  static void measure_energy(const Run& run, Measured& out) {
    std::vector<double> t, energy;
    const double first = run.history.front().kinetic_energy;
    double highest = 0;
    for (const HistoryRow& row : run.history) {
      t.push_back(row.time / run.number("quarter"));
      energy.push_back((row.kinetic_energy + row.elastic_energy) / first);
      highest = std::max(highest, energy.back());
    }
    out.value("energy lost", 1 - energy.back());
    out.value("energy gained", highest - 1);
    out.figure("Kinetic and elastic energy", "time over the quarter period",
               "energy over the first")
        .computed(t, energy)
        .exact({0, t.back()}, {1, 1});
  }
};

}  // namespace scree::verify::cases::twisting_bar
