// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "solver/geometry/triangle_tree.hpp"

namespace scree {
namespace {

using Kind = TriangleFeature::Kind;

double dot(const double u[3], const double v[3]) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

void subtract(const double a[3], const double b[3], double result[3]) {
  for (int i = 0; i < 3; ++i) result[i] = a[i] - b[i];
}

/// Keeps the point a + t (b - a) if it is nearer than what is known.
void try_edge(const double a[3], const double b[3], int index, const double x[3],
              NearestPoint& best) {
  double along[3], to[3];
  subtract(b, a, along);
  subtract(x, a, to);
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(along, to) / square, 0.0, 1.0) : 0.0;
  NearestPoint near;
  double gap[3];
  for (int i = 0; i < 3; ++i) {
    near.point[std::size_t(i)] = t == 1 ? b[i] : a[i] + t * along[i];
    gap[i] = x[i] - near.point[std::size_t(i)];
  }
  near.square = dot(gap, gap);
  if (!(near.square < best.square)) return;
  best.square = near.square;
  best.point = near.point;
  const bool end = t == 0 || t == 1;
  best.feature = {end ? Kind::corner : Kind::edge, t == 1 ? (index + 1) % 3 : index};
}

}  // namespace

NearestPoint nearest_on_triangle(const double a[3], const double b[3], const double c[3],
                                 const double x[3]) {
  const double* corner[3] = {a, b, c};
  double u[3], v[3], normal[3], to[3];
  subtract(b, a, u);
  subtract(c, a, v);
  subtract(x, a, to);
  for (int i = 0; i < 3; ++i)
    normal[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
  const double square = dot(normal, normal);
  bool above = square > 0;  // the foot of x on the plane lies within all three edges
  for (int e = 0; above && e < 3; ++e) {
    double along[3], from[3], inward[3];
    subtract(corner[(e + 1) % 3], corner[e], along);
    subtract(x, corner[e], from);
    for (int i = 0; i < 3; ++i)
      inward[i] =
          normal[(i + 1) % 3] * along[(i + 2) % 3] - normal[(i + 2) % 3] * along[(i + 1) % 3];
    above = dot(inward, from) > 0;
  }
  NearestPoint best;
  if (above) {
    const double height = dot(normal, to) / square;
    for (std::size_t i = 0; i < 3; ++i) best.point[i] = x[i] - height * normal[i];
    best.square = height * height * square;
    return best;
  }
  for (int e = 0; e < 3; ++e) try_edge(corner[e], corner[(e + 1) % 3], e, x, best);
  return best;
}

}  // namespace scree
