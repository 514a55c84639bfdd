// SPDX-License-Identifier: Apache-2.0
//
// In a body without stress, a step of particle-in-cell maps the particles' velocities as
//   v' = 1/L sum_k W_k diag(1/m_k) W_k^T (m v),     m_k = W_k^T m,
// over the L lattices of the kernel (compact: nodes at i and at i + 1/2, L = 2; quadratic and hat
// functions: nodes at i, L = 1): the weighted mean over particles at the nodes, and back. W_k is
// symmetric under the product with masses, so this filter has real eigenvalues from 0 to 1;
// v.v'/v.v is how much it keeps of v. A lattice of particles that fills a periodic strip has equal
// sums across it, so one dimension tells all. The kernels are written out here, from their
// definitions:
//   compact    1 - |x| + sin(2 pi |x|)/(2 pi), |x| < 1 (M. Liu, X. Wang, M. Li, CK-MPM, ACM TOG
//              44(4), 2025, equation 8);
//   quadratic  3/4 - x^2 for |x| < 1/2, (3/2 - |x|)^2/2 for |x| < 3/2;
//   linear     1 - |x|, |x| < 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::pic_filter {

/// Weight of a node at the distance x [cells].
inline double weight(const std::string& kernel, double x) {
  constexpr double turn = 6.28318530717958647692;
  const double a = std::abs(x);
  if (kernel == "quadratic") {
    return a < 0.5 ? 0.75 - a * a : a < 1.5 ? (1.5 - a) * (1.5 - a) / 2 : 0;
  }
  if (a >= 1) return 0;
  return kernel == "linear" ? 1 - a : 1 - a + std::sin(turn * a) / turn;
}

/// The map of one step: velocities v of particles at x [cells], all of one mass, in a periodic bar.
inline std::vector<double> filtered(const std::string& kernel, int cells,
                                    const std::vector<double>& x, const std::vector<double>& v) {
  const int lattices = kernel == "compact" ? 2 : 1;
  std::vector<double> out(x.size(), 0.0);
  for (int k = 0; k < lattices; ++k) {
    for (int node = 0; node < cells; ++node) {
      double mass = 0, momentum = 0;
      std::vector<double> w(x.size());
      for (std::size_t p = 0; p < x.size(); ++p) {
        const double off = x[p] - (node + 0.5 * k);
        w[p] = weight(kernel, off - cells * std::round(off / cells));
        mass += w[p];
        momentum += w[p] * v[p];
      }
      for (std::size_t p = 0; p < x.size(); ++p) out[p] += w[p] * momentum / mass / lattices;
    }
  }
  return out;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const ParticleFrame first = run.frame(0), last = run.frame();
    const Column before = first.field("velocity"), after = last.field("velocity");
    const double v0 = run.number("v0"), cell = run.number("cell");
    std::vector<double> x, v;
    for (std::size_t p = 0; p < first.size(); ++p) {
      x.push_back(first.x(p)[0] / cell);
      v.push_back(before(p, 0));
    }
    const int cells = static_cast<int>(std::lround(run.number("cells")));
    const std::vector<double> exact = filtered(run.text("kernel"), cells, x, v);
    double off = 0, kept = 0, kept_exactly = 0, norm = 0;
    std::vector<double> place, got, wanted;
    for (std::size_t p = 0; p < x.size(); ++p) {
      off = std::max(off, std::abs(after(p, 0) - exact[p]) / v0);
      kept += v[p] * after(p, 0);
      kept_exactly += v[p] * exact[p];
      norm += v[p] * v[p];
      if (first.x(p)[1] > cell / run.number("ppd")) continue;  // the lowest row
      place.push_back(x[p]);
      got.push_back(after(p, 0) / v0);
      wanted.push_back(exact[p] / v0);
    }
    out.value("map error", off);
    out.value("kept", kept / norm, kept_exactly / norm);
    out.value("lost", 1 - kept / norm);
    out.figure("Velocity after a step", "x (cells)", "over that of the wave before")
        .particles(place, got)
        .exact(place, wanted);
  }
};

}  // namespace scree::verify::cases::pic_filter
