// SPDX-License-Identifier: Apache-2.0
//
// A standing wave in a confined, periodic bar of a fixed-corotated solid. Confined, its nominal
// stress is P = (lambda + 2 mu)(F_xx - 1), linear at any amplitude, so momentum in the material
// coordinate is the wave equation u_tt = c^2 u_XX, c^2 = (lambda + 2 mu)/rho0. From rest with the
// velocity v0 sin(pi X/L), L = 1 m,
//   u = v0/w sin(w t) sin(pi X/L),   w = pi c/L,   period T = 2 L/c,
// and the energy, kinetic and elastic, is constant.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::bar_vibration {

/// Times at which a sampled amplitude passes through zero, by straight lines between samples
/// (32 samples a period: the phase is right to 1e-4 rad).
inline std::vector<double> zero_crossings(const std::vector<double>& t,
                                          const std::vector<double>& a) {
  std::vector<double> times;
  for (std::size_t i = 1; i < a.size(); ++i) {
    if (a[i - 1] * a[i] > 0 || a[i] == a[i - 1]) continue;
    times.push_back(t[i - 1] + (t[i] - t[i - 1]) * a[i - 1] / (a[i - 1] - a[i]));
  }
  return times;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double period = run.number("period"), v0 = run.number("v0");
    std::vector<double> t, amplitude, exact;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      const Column velocity = frame.field("velocity");
      double projected = 0, norm = 0;
      for (std::size_t p = 0; p < frame.size(); ++p) {
        const double mode = std::sin(std::numbers::pi * frame.X(p)[0]);
        projected += velocity(p, 0) * mode;
        norm += mode * mode;
      }
      t.push_back(frame.time() / period);
      amplitude.push_back(projected / norm / v0);
      exact.push_back(std::cos(2 * std::numbers::pi * frame.time() / period));
    }
    // Crossings lie at 1/4, 3/4, ... periods: their mean distance is half a period.
    const std::vector<double> zeros = zero_crossings(t, amplitude);
    const double between = (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
    out.value("period error", std::abs(2 * between - 1));
    out.figure("Amplitude of the velocity", "time over period", "amplitude over v0")
        .computed(t, amplitude)
        .exact(t, exact);
    measure_energy(run, out);
  }

 private:
  /// Energies are compared after whole periods: within one, that of symplectic Euler swings by
  /// w dt/2 of itself.
  static void measure_energy(const Run& run, Measured& out) {
    constexpr std::size_t rows_a_period = 32;
    std::vector<double> t, energy;
    double largest_gain = 0;
    for (std::size_t i = 0; i < run.history.size(); i += rows_a_period) {
      const HistoryRow& row = run.history[i];
      t.push_back(row.time / run.number("period"));
      energy.push_back((row.kinetic_energy + row.elastic_energy) / run.history[0].kinetic_energy);
      const std::size_t n = energy.size();
      if (n > 1) largest_gain = std::max(largest_gain, energy[n - 1] / energy[n - 2] - 1);
    }
    out.value("energy lost", 1 - energy.back());
    out.value("energy gained", largest_gain);
    out.figure("Energy", "time over period", "kinetic and elastic energy over the first")
        .computed(t, energy)
        .exact({0, run.number("periods")}, {1, 1});
  }
};

}  // namespace scree::verify::cases::bar_vibration
