// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/particles/shape_primitives.hpp"

namespace scree {

double signed_area(const std::vector<std::array<double, 2>>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Relative to the first corner, so that a polygon far from the origin keeps its digits.
    const auto& p = points[i];
    const auto& q = points[(i + 1) % points.size()];
    const double px = p[0] - points[0][0], py = p[1] - points[0][1];
    const double qx = q[0] - points[0][0], qy = q[1] - points[0][1];
    twice += px * qy - py * qx;
  }
  return 0.5 * twice;
}

PolygonShape::PolygonShape(std::vector<std::array<double, 2>> points,
                           const std::array<double, 3>& z, int dimension)
    : Shape(dimension), points_(std::move(points)), z_(z), size_(0) {
  if (signed_area(points_) < 0) std::reverse(points_.begin(), points_.end());
  for (const auto& p : points_) size_ = std::max({size_, std::abs(p[0]), std::abs(p[1])});
}

PolygonShape::Nearest PolygonShape::nearest(const double x[3]) const {
  Nearest best{std::numeric_limits<double>::infinity(), {0, 0}, 0};
  double best_square = best.distance;
  bool inside = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto& p = points_[i];
    const auto& q = points_[(i + 1) % points_.size()];
    const double edge[2] = {q[0] - p[0], q[1] - p[1]};
    const double from[2] = {x[0] - p[0], x[1] - p[1]};
    const double square = edge[0] * edge[0] + edge[1] * edge[1];
    const double along = square > 0 ? (from[0] * edge[0] + from[1] * edge[1]) / square : 0;
    const double s = std::clamp(along, 0.0, 1.0);
    const double away[2] = {from[0] - s * edge[0], from[1] - s * edge[1]};
    const double distance = away[0] * away[0] + away[1] * away[1];
    if (distance < best_square) {
      best_square = distance;
      best = {0, {away[0], away[1]}, i};
    }
    // Even-odd rule along the ray to +x; half-open in y, so a corner on the ray counts once.
    if ((p[1] > x[1]) != (q[1] > x[1])) {
      const double side = edge[0] * from[1] - edge[1] * from[0];
      if ((side > 0) == (edge[1] > 0)) inside = !inside;
    }
  }
  best.distance = (inside ? -1 : 1) * std::sqrt(best_square);
  return best;
}

void PolygonShape::outline_normal(const Nearest& near, double n[2]) const {
  const double distance = std::abs(near.distance);
  if (distance > 1e-12 * size_) {
    n[0] = near.away[0] / near.distance;
    n[1] = near.away[1] / near.distance;
    return;
  }
  // On the outline the direction to it is noise: take the edge's own normal.
  const auto& p = points_[near.edge];
  const auto& q = points_[(near.edge + 1) % points_.size()];
  const double edge = std::hypot(q[0] - p[0], q[1] - p[1]);
  n[0] = (q[1] - p[1]) / edge;
  n[1] = -(q[0] - p[0]) / edge;
}

double PolygonShape::signed_distance(const double x[3]) const {
  const double outline = nearest(x).distance;
  if (dimension() == 2) return outline;
  return Wedge(outline, std::max(z_[0] - x[2], x[2] - z_[1])).distance;
}

void PolygonShape::normal(const double x[3], double n[3]) const {
  const Nearest near = nearest(x);
  outline_normal(near, n);
  n[2] = 0;
  if (dimension() == 2) return;
  const double below = z_[0] - x[2], above = x[2] - z_[1];
  const Wedge wedge(near.distance, std::max(below, above));
  n[0] *= wedge.weight[0];
  n[1] *= wedge.weight[0];
  n[2] = below > above ? -wedge.weight[1] : wedge.weight[1];
}

Box PolygonShape::bounds() const {
  Box box;
  for (int a = 0; a < 2; ++a) {
    const auto [least, most] = std::minmax_element(
        points_.begin(), points_.end(), [a](const auto& p, const auto& q) { return p[a] < q[a]; });
    box.lower[a] = (*least)[a];
    box.upper[a] = (*most)[a];
  }
  if (dimension() == 3) {
    box.lower[2] = z_[0];
    box.upper[2] = z_[1];
  }
  return box;
}

}  // namespace scree
