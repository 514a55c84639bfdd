// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/triangle_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

namespace scree {

std::string place_of(const TriangleMesh::Point& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
}

TriangleMesh::Point Placement::operator()(const TriangleMesh::Point& x) const {
  TriangleMesh::Point y{scale * x[0], scale * x[1], scale * x[2]};
  if (angle != 0) {
    // Rodrigues' formula.
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    const double k[3] = {axis[0] / length, axis[1] / length, axis[2] / length};
    const double c = std::cos(angle), s = std::sin(angle);
    const double along = (1 - c) * (k[0] * y[0] + k[1] * y[1] + k[2] * y[2]);
    const TriangleMesh::Point v = y;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, d = (a + 2) % 3;
      y[std::size_t(a)] = c * v[std::size_t(a)] +
                          s * (k[b] * v[std::size_t(d)] - k[d] * v[std::size_t(b)]) + along * k[a];
    }
  }
  for (std::size_t a = 0; a < 3; ++a) y[a] += shift[a];
  return y;
}

}  // namespace scree
