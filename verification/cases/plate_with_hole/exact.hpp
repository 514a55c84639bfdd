// SPDX-License-Identifier: Apache-2.0
//
// Infinite plate with a round hole of radius a, pulled with S along x (G. Kirsch, Zeitschrift des
// VDI 42, 1898; S. Timoshenko, J. N. Goodier, Theory of Elasticity, 1951, article 32), in Cartesian
// components with theta from x and k = (a/r)^2:
//   s_xx/S = 1 - k (3/2 cos 2t + cos 4t) + 3/2 k^2 cos 4t
//   s_yy/S =   - k (1/2 cos 2t - cos 4t) - 3/2 k^2 cos 4t
//   s_xy/S =   - k (1/2 sin 2t + sin 4t) + 3/2 k^2 sin 4t
// The quarter 0 < x, y < 4 a carries these as tractions on its outer sides, so that its own
// solution is the same: no error from a finite plate. In plane strain they hold as well.
#pragma once

#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::plate_with_hole {

struct Plane {
  double xx, yy, xy;
};

/// Stress over S at (x, y), in radii of the hole.
inline Plane kirsch(double x, double y) {
  const double r2 = x * x + y * y, k = 1 / r2, t = std::atan2(y, x);
  const double c2 = std::cos(2 * t), c4 = std::cos(4 * t);
  const double s2 = std::sin(2 * t), s4 = std::sin(4 * t);
  return {1 - k * (1.5 * c2 + c4) + 1.5 * k * k * c4, -k * (0.5 * c2 - c4) - 1.5 * k * k * c4,
          -k * (0.5 * s2 + s4) + 1.5 * k * k * s4};
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double S = run.number("S"), cell = run.number("cell"), side = run.number("side");
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress"), volume = end.field("volume");
    double off = 0, all = 0;
    std::vector<double> y, hoop, exact_y, exact_hoop;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double x = end.X(p)[0], h = end.X(p)[1], r = std::hypot(x, h);
      const Plane exact = kirsch(x, h);
      const double dx = stress(p, 0, 0) / S - exact.xx, dy = stress(p, 1, 1) / S - exact.yy,
                   dxy = stress(p, 0, 1) / S - exact.xy;
      if (r > 1.25 && x < side - 2 * cell && h < side - 2 * cell) {
        off += (dx * dx + dy * dy + 2 * dxy * dxy) * volume(p);
        all += (exact.xx * exact.xx + exact.yy * exact.yy + 2 * exact.xy * exact.xy) * volume(p);
      }
      if (x > cell || r < 1) continue;
      y.push_back(h);
      hoop.push_back(stress(p, 0, 0) / S);
    }
    out.value("stress error", std::sqrt(off / all));
    out.value("concentration", concentration(y, hoop), 1.0);
    const HistoryRow& last = run.history.back();
    out.value("rest", last.kinetic_energy / last.elastic_energy);
    for (int i = 0; i <= 100; ++i) {
      exact_y.push_back(1 + 0.03 * i);
      exact_hoop.push_back(kirsch(0, exact_y.back()).xx);
    }
    out.figure("Hoop stress over the hole", "y/a in the first cell beside x = 0", "stress over S")
        .particles(y, hoop)
        .exact(exact_y, exact_hoop, "Kirsch");
  }

 private:
  /// Force over 1.25 a < y < 2 a beside x = 0, over the exact one: ratio of the sums of the stress.
  static double concentration(const std::vector<double>& y, const std::vector<double>& hoop) {
    double sum = 0, exact = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (y[i] < 1.25 || y[i] > 2) continue;
      sum += hoop[i];
      exact += kirsch(0, y[i]).xx;
    }
    return sum / exact;
  }
};

}  // namespace scree::verify::cases::plate_with_hole
