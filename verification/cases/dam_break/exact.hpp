// SPDX-License-Identifier: Apache-2.0
//
// Collapse of a column of water, width L and height H = 2 L, on a smooth dry floor: the front
// against the experiment of S. Koshizuka, Y. Oka, Nucl. Sci. Eng. 123, 1996 (read off their figure;
// time in sqrt(L/(2 g)), place in L), and that of J. C. Martin, W. J. Moyce, Phil. Trans. A 244,
// 1952, L = 2.25 in, as kept with PySPH: the same proportions, three times smaller, for longer.
//
// Emptying of a long reservoir of depth h0 (A. Ritter, Zeitschrift des VDI 36, 1892), shallow and
// without friction, the dam at x = 0, water at x < 0, c = sqrt(g h0):
//   h = h0                           x/t < -c
//   h = (2 c - x/t)^2/(9 g)          -c < x/t < 2 c
//   h = 0                            2 c < x/t.
// Real water is not shallow at the start, when the wall of water falls freely: h differs by some
// per cent of h0 for the times of a laboratory.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "verification/suite/front.hpp"
#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::dam_break {

/// Depth of the shallow water solution [m]; x from the dam [m], c [m/s], g [m/s^2].
inline double ritter(double x, double t, double h0, double g) {
  const double c = std::sqrt(g * h0), speed = x / t;
  if (speed <= -c) return h0;
  if (speed >= 2 * c) return 0;
  return (2 * c - speed) * (2 * c - speed) / (9 * g);
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    measure_energy(run, out);
    if (run.text("kind") != "long reservoir") {
      measure_front(run, run.text("kind") == "column" ? koshizuka() : martin(), out);
    } else {
      measure_depth(run, out);
    }
  }

 private:
  static double front(const ParticleFrame& frame) {
    std::vector<double> x;
    for (std::size_t p = 0; p < frame.size(); ++p) x.push_back(frame.x(p)[0]);
    return front_of(std::move(x));
  }

  /// Front of an experiment: times in sqrt(L/(2 g)), places in L.
  struct Experiment {
    std::string name;
    std::vector<double> T, Z;
  };
  static Experiment koshizuka() {
    return {"Koshizuka, Oka 1996",
            {0.381, 0.769, 1.153, 1.537, 1.935, 2.323, 2.719, 3.096},
            {1.111, 1.252, 1.505, 1.892, 2.241, 2.615, 3.003, 3.624}};
  }
  static Experiment martin() {
    return {"Martin, Moyce 1952",
            {0.832, 1.219, 1.997, 2.547, 3.345, 4.034, 4.418, 5.091},
            {1.217, 1.474, 2.292, 2.995, 4.134, 4.944, 5.881, 6.980}};
  }

  static void measure_front(const Run& run, const Experiment& experiment, Measured& out) {
    const std::vector<double>&T = experiment.T, &Z = experiment.Z;
    std::vector<double> t, z;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      t.push_back(frame.time() / run.number("lead"));
      z.push_back(front(frame) / run.number("width"));
    }
    double largest = 0;
    for (std::size_t i = 0; i < T.size(); ++i) {
      const std::size_t after = std::size_t(std::upper_bound(t.begin(), t.end(), T[i]) - t.begin());
      const double share = (T[i] - t[after - 1]) / (t[after] - t[after - 1]);
      const double here = z[after - 1] + share * (z[after] - z[after - 1]);
      largest = std::max(largest, std::abs(here / Z[i] - 1));
    }
    out.value("front error", largest);
    // The slope of the last part, where the flow runs steadily.
    const std::size_t last = t.size() - 1, from = last * 5 / 8;
    out.value("front speed", (z[last] - z[from]) / (t[last] - t[from]));
    out.figure("Front of the " + run.text("kind"), "t sqrt(2 g/L)", "front/L")
        .computed(t, z)
        .published(T, Z, experiment.name);
  }

  /// Depth in strips of two cells: volume over width.
  static void measure_depth(const Run& run, Measured& out) {
    const ParticleFrame end = run.frame();
    const Column volume = end.field("volume");
    const double strip = 2 * run.number("cell"), dam = run.number("width");
    const double h0 = run.number("height"), g = run.number("g");
    std::vector<double> x, h, exact;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const std::size_t i = static_cast<std::size_t>(std::max(end.x(p)[0], 0.0) / strip);
      if (i >= h.size()) h.resize(i + 1, 0);
      h[i] += volume(p) / strip;
    }
    double off = 0, total = 0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      x.push_back((double(i) + 0.5) * strip);
      exact.push_back(ritter(x[i] - dam, end.time(), h0, g));
      off += std::abs(h[i] - exact[i]);
      total += exact[i];
    }
    out.value("depth error", off / total);
    const std::size_t at = static_cast<std::size_t>(dam / strip);
    out.value("depth at the dam", (h[at - 1] + h[at]) / 2 / h0, 4.0 / 9);
    const double c = std::sqrt(g * h0);
    out.value("front speed over 2 c", (front(end) - dam) / end.time() / (2 * c));
    out.figure("Depth of the emptying reservoir", "x (m)", "depth (m)")
        .computed(x, h)
        .exact(x, exact, "Ritter 1892");
  }

  /// Kinetic and potential energy may turn into heat, never grow; compression comes and goes.
  static void measure_energy(const Run& run, Measured& out) {
    const double g = run.number("g"), mass = run.history[0].mass;
    const double first = mass * g * run.number("height") / 2;
    std::vector<double> t, energy;
    double highest = 0;
    for (const HistoryRow& row : run.history) {
      const double here = row.kinetic_energy + row.mass * g * row.center[1];
      t.push_back(row.time / run.number("lead"));
      energy.push_back(here / first);
      highest = std::max(highest, here / first);
    }
    out.value("energy gained", highest - 1);
    out.figure("Energy, " + run.text("kind"), "t sqrt(2 g/L)",
               "kinetic and potential over the first")
        .computed(t, energy)
        .exact({0, t.back()}, {1, 1}, "at the start");
  }
};

}  // namespace scree::verify::cases::dam_break
