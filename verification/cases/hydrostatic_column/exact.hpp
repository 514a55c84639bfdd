// SPDX-License-Identifier: Apache-2.0
//
// A weakly compressible fluid p = B ((rho/rho0)^gamma - 1) at rest under gravity. dp/dz = rho g
// with z the depth and rho = rho0 (1 + p/B)^(1/gamma) integrates to
//   p(z) = B ((1 + n rho0 g z/B)^(1/n) - 1),   n = (gamma - 1)/gamma.
// In the material coordinate Z (depth before gravity acts) the weight above is exactly rho0 g Z:
//   p = rho0 g Z,
// whatever the fluid's law: this is what the particles are compared with, since each knows its Z.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::hydrostatic_column {

/// Pressure at a depth below the settled surface [Pa].
inline double pressure_at(double z, double density, double g, double B, double gamma) {
  const double n = (gamma - 1) / gamma;
  return B * (std::pow(1 + n * density * g * z / B, 1 / n) - 1);
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double depth = run.number("depth"), weight = run.number("density") * run.number("g");
    const ParticleFrame end = run.frame(), before = run.frame(1);
    const Column pressure = end.field("pressure"), volume = end.field("volume");
    double squares = 0, total = 0;
    std::map<int, std::vector<double>> levels;  // errors by the particles' layer
    std::vector<double> height, kilopascals;
    double lowest = 1e9, highest = -1e9, drift = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double exact = weight * (depth - end.X(p)[1]), off = pressure(p) - exact;
      squares += off * off * volume(p);
      total += volume(p);
      const int layer = int(end.X(p)[1] / run.number("cell") * run.number("ppd"));
      levels[layer].push_back(off);
      drift += (end.x(p)[1] - before.x(p)[1]) / double(end.size());
      height.push_back(end.x(p)[1]);
      kilopascals.push_back(pressure(p) / 1e3);
    }
    const double spacing = run.number("cell") / run.number("ppd");
    for (std::size_t p = 0; p < end.size(); ++p) {
      if (end.X(p)[1] < depth - spacing) continue;
      lowest = std::min(lowest, end.x(p)[1]);
      highest = std::max(highest, end.x(p)[1]);
    }
    out.value("pressure error", std::sqrt(squares / total) / (weight * depth));
    out.value("scatter", scatter(levels) / (weight * depth));
    out.value("drift", std::abs(drift) / depth);
    out.value("surface", (highest - lowest) / run.number("cell"));
    draw(run, height, kilopascals, out);
  }

 private:
  /// Largest standard deviation of the pressure among the particles of one layer.
  static double scatter(const std::map<int, std::vector<double>>& levels) {
    double largest = 0;
    for (const auto& [layer, off] : levels) {
      double mean = 0, squares = 0;
      for (double x : off) mean += x / double(off.size());
      for (double x : off) squares += (x - mean) * (x - mean) / double(off.size());
      largest = std::max(largest, std::sqrt(squares));
    }
    return largest;
  }

  static void draw(const Run& run, const std::vector<double>& height,
                   const std::vector<double>& kilopascals, Measured& out) {
    const double density = run.number("density"), g = run.number("g"), B = run.number("B");
    // The settled surface: the mass rho0 depth = integral of rho; by bisection on its pressure
    // head.
    const double bottom = density * g * run.number("depth");
    double low = 0, high = run.number("depth");
    for (int i = 0; i < 60; ++i) {
      const double z = (low + high) / 2;
      (pressure_at(z, density, g, B, run.number("gamma")) < bottom ? low : high) = z;
    }
    std::vector<double> y, p;
    for (int i = 0; i <= 40; ++i) {
      y.push_back(low * i / 40);
      p.push_back(pressure_at(low - y.back(), density, g, B, run.number("gamma")) / 1e3);
    }
    out.figure("Pressure", "height (m)", "pressure (kPa)")
        .particles(height, kilopascals)
        .exact(y, p);
  }
};

}  // namespace scree::verify::cases::hydrostatic_column
