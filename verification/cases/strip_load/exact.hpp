// SPDX-License-Identifier: Apache-2.0
//
// Undrained elastic ground of depth H on a smooth rigid base, plane strain, loaded by strips of
// pressure q and width 2 B, one every 2 W: between mirror planes x = 0 and x = W one half of one.
//
// Soil and water keep their volume, so the soil's effective stress has no mean in the plane and the
// water's pressure is the mean total stress, p = -(sigma_xx + sigma_yy)/2. With Airy's function
// (C cosh k y + D k y sinh k y) cos k x, y from the base, which has no shear there, none at y = H
// and sigma_yy = -q_k cos k x at y = H (S. Timoshenko, J. N. Goodier, Theory of Elasticity, art.
// 24):
//   p_k = q_k sinh(kH) cosh(k y)/(sinh(kH) cosh(kH) + k H) cos k x,
// k = m pi/W, q_k = 2 q sin(k B)/(k W) and q_0 = p_0 = q B/W. Without the base this is q/pi times
// the angle under which the strip is seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::strip_load {

struct Ground {
  double width, height, strip;  ///< W, H, B [m]

  /// p/q.
  double pressure(double x, double y) const {
    double sum = strip / width;
    for (int m = 1; m < 400; ++m) {
      const double k = m * std::numbers::pi / width, e = std::exp(-2 * k * height);
      // sinh(kH) cosh(ky) and sinh(kH) cosh(kH) + kH, both over exp(2 kH)
      const double above = (std::exp(k * (y - height)) + std::exp(-k * (y + height))) * (1 - e) / 4;
      const double below = (1 - e * e) / 4 + k * height * e;
      sum += 2 * std::sin(k * strip) / (k * width) * above / below * std::cos(k * x);
    }
    return sum;
  }
};

/// Means over square bins, and how rough they are.
class Bins {
 public:
  Bins(double side, const Ground& ground)
      : side_(side),
        columns_(std::lround(ground.width / side)),
        rows_(std::lround(ground.height / side)),
        sum_(std::size_t(columns_ * rows_), 0.0),
        count_(sum_) {}
  void add(double x, double y, double value) {
    const long i = std::min(long(x / side_), columns_ - 1),
               j = std::min(long(y / side_), rows_ - 1);
    sum_[std::size_t(i * rows_ + j)] += value;
    count_[std::size_t(i * rows_ + j)] += 1;
  }
  /// Root of the mean square of the mixed second difference, a quarter of it: a checkerboard of +1
  /// and -1 has 1, a field that is linear or varies along one axis only 0.
  double roughness() const {
    double square = 0;
    for (long i = 1; i < columns_; ++i) {
      for (long j = 1; j < rows_; ++j) {
        const double mixed = mean(i, j) - mean(i - 1, j) - mean(i, j - 1) + mean(i - 1, j - 1);
        square += mixed * mixed / 16;
      }
    }
    return std::sqrt(square / double((columns_ - 1) * (rows_ - 1)));
  }

 private:
  double mean(long i, long j) const {
    const std::size_t k = std::size_t(i * rows_ + j);
    return sum_[k] / count_[k];
  }
  double side_;
  long columns_, rows_;
  std::vector<double> sum_, count_;
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const Ground exact{run.number("width"), run.number("height"), run.number("strip")};
    const double load = run.number("load");
    const ParticleFrame end = run.frame();
    const auto pressure = end.field("pore_pressure");
    Bins measured(run.number("spacing") * run.number("cell"), exact), right(measured);
    double deep = 0, count = 0, corner = 0;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double x = end.X(p)[0], y = end.X(p)[1];
      const double value = pressure(p) / load, wanted = exact.pressure(x, y);
      measured.add(x, y, value);
      right.add(x, y, wanted);
      if (y > exact.height - exact.strip) continue;
      if (std::max(x, y) < run.number("cell")) {
        corner = std::max(corner, std::abs(value - wanted));
      }
      deep += (value - wanted) * (value - wanted);
      ++count;
    }
    out.value("roughness", measured.roughness(), right.roughness());
    out.value("roughness over the exact one", measured.roughness() / right.roughness());
    out.value("pressure error", std::sqrt(deep / count));
    out.value("corner", corner);
    const HistoryRow& last = run.history.back();
    out.value("rest", last.kinetic_energy / last.elastic_energy);
    out.value("water balance", std::abs(last.fluid->error));
    below_strip(run, exact, out);
  }

 private:
  static void below_strip(const Run& run, const Ground& exact, Measured& out) {
    const ParticleFrame end = run.frame();
    const auto pressure = end.field("pore_pressure");
    std::vector<double> depth, below, line, curve;
    for (std::size_t p = 0; p < end.size(); ++p) {
      if (end.X(p)[0] > run.number("cell")) continue;
      depth.push_back(end.X(p)[1] / exact.height);
      below.push_back(pressure(p) / run.number("load"));
    }
    for (int i = 0; i <= 60; ++i) {
      line.push_back(i / 60.0);
      curve.push_back(exact.pressure(run.number("cell") / 2, line.back() * exact.height));
    }
    out.figure("Pore pressure below the middle of the strip", "p/q", "height y/H")
        .particles(below, depth)
        .exact(curve, line);
  }
};

}  // namespace scree::verify::cases::strip_load
