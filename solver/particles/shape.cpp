// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/base/error.hpp"
#include "solver/particles/shape_combination.hpp"
#include "solver/particles/shape_file.hpp"
#include "solver/particles/shape_polygon.hpp"
#include "solver/particles/shape_primitives.hpp"

namespace scree {

bool Box::bounded(int dimension) const {
  for (int a = 0; a < dimension; ++a)
    if (!std::isfinite(lower[a]) || !std::isfinite(upper[a])) return false;
  return true;
}

std::array<double, 3> Shape::reference_point() const {
  const Box box = bounds();
  std::array<double, 3> center{};
  for (int a = 0; a < dimension_; ++a)
    if (std::isfinite(box.lower[a]) && std::isfinite(box.upper[a]))
      center[a] = 0.5 * (box.lower[a] + box.upper[a]);
  return center;
}

namespace {

using Corner = std::array<double, 2>;
using Found = std::optional<ShapeProblem>;

bool vanishes(const std::array<double, 3>& v, int dimension) {
  return std::all_of(v.begin(), v.begin() + dimension, [](double a) { return a == 0; });
}

Found box_problem(const ShapeSpec& spec, int dimension) {
  for (int a = 0; a < dimension; ++a)
    if (!(spec.lower[a] < spec.upper[a]))
      return ShapeProblem{"upper", "the upper corner must lie above the lower one in every axis"};
  return std::nullopt;
}

/// The comparison is the quiet one: a radius that is not a number is a mistake, not a trap.
Found radius_problem(const ShapeSpec& spec) {
  if (std::isgreater(spec.radius, 0.0)) return std::nullopt;
  return ShapeProblem{"radius", "the radius must be positive"};
}

Found cylinder_problem(const ShapeSpec& spec, int dimension) {
  std::array<double, 3> axis{};
  for (int a = 0; a < dimension; ++a) axis[a] = spec.to[a] - spec.from[a];
  if (vanishes(axis, dimension))
    return ShapeProblem{"to", "the ends of a cylinder must be two different points"};
  return radius_problem(spec);
}

/// On which side of the line from p to q the point lies: the sign.
double side(const Corner& p, const Corner& q, const Corner& point) {
  return (q[0] - p[0]) * (point[1] - p[1]) - (q[1] - p[1]) * (point[0] - p[0]);
}

/// Two sides that cross inside both, or nothing; corners that only touch are let pass.
Found crossing_problem(const std::vector<Corner>& points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Corner &a = points[i], &b = points[(i + 1) % count];
    for (std::size_t j = i + 2; j < count; ++j) {
      const Corner &c = points[j], &d = points[(j + 1) % count];
      if (!(side(a, b, c) * side(a, b, d) < 0) || !(side(c, d, a) * side(c, d, b) < 0)) continue;
      return ShapeProblem{"points", "the sides " + std::to_string(i + 1) + " and " +
                                        std::to_string(j + 1) +
                                        " cross; give the corners in the order of the outline"};
    }
  }
  return std::nullopt;
}

Found polygon_problem(const ShapeSpec& spec, int dimension) {
  if (spec.points.size() < 3)
    return ShapeProblem{"points", "a polygon needs at least three corners"};
  for (std::size_t i = 0; i < spec.points.size(); ++i)
    if (spec.points[i] == spec.points[(i + 1) % spec.points.size()])
      return ShapeProblem{"points", "two corners that follow each other are the same point"};
  if (Found crossing = crossing_problem(spec.points)) return crossing;
  double square = 0;  // of the longest edge: the scale of an area
  for (std::size_t i = 0; i < spec.points.size(); ++i) {
    const auto& p = spec.points[i];
    const auto& q = spec.points[(i + 1) % spec.points.size()];
    square = std::max(square, (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]));
  }
  if (!(std::abs(signed_area(spec.points)) > 1e-12 * square))
    return ShapeProblem{"points", "the corners lie on a line: the polygon has no area"};
  if (dimension == 3 && !(spec.z[0] < spec.z[1]))
    return ShapeProblem{"z", "a polygon in 3D needs z = [a, b] with a below b"};
  return std::nullopt;
}

Found combination_problem(const ShapeSpec& spec, int dimension) {
  if (spec.of.empty()) return ShapeProblem{"of", "the list of shapes is empty"};
  for (std::size_t i = 0; i < spec.of.size(); ++i)
    if (Found inner = find_problem(spec.of[i], dimension)) {
      inner->key = "of[" + std::to_string(i) + "]." + inner->key;
      return inner;
    }
  return std::nullopt;
}

ShapeList make_parts(const ShapeSpec& spec, int dimension) {
  ShapeList parts;
  for (const ShapeSpec& part : spec.of) parts.push_back(make_shape(part, dimension));
  return parts;
}

}  // namespace

std::optional<ShapeProblem> find_problem(const ShapeSpec& spec, int dimension) {
  switch (spec.kind) {
    case ShapeKind::box:
      return box_problem(spec, dimension);
    case ShapeKind::sphere:
      return radius_problem(spec);
    case ShapeKind::cylinder:
      return cylinder_problem(spec, dimension);
    case ShapeKind::polygon:
      return polygon_problem(spec, dimension);
    case ShapeKind::plane:
      if (vanishes(spec.normal, dimension))
        return ShapeProblem{"normal", "the normal of a plane must not be zero"};
      return std::nullopt;
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      return find_file_problem(spec, dimension);
    case ShapeKind::union_of:
    case ShapeKind::difference:
    case ShapeKind::intersection:
      return combination_problem(spec, dimension);
  }
  return ShapeProblem{"type", "not a type of shape"};
}

std::unique_ptr<Shape> make_shape(const ShapeSpec& spec, int dimension) {
  if (const Found problem = find_problem(spec, dimension))
    throw UserError("shape." + problem->key + ": " + problem->message);
  switch (spec.kind) {
    case ShapeKind::box:
      return std::make_unique<BoxShape>(spec.lower, spec.upper, dimension);
    case ShapeKind::sphere:
      return std::make_unique<SphereShape>(spec.center, spec.radius, dimension);
    case ShapeKind::cylinder:
      return std::make_unique<CylinderShape>(spec.from, spec.to, spec.radius, dimension);
    case ShapeKind::polygon:
      return std::make_unique<PolygonShape>(spec.points, spec.z, dimension);
    case ShapeKind::plane:
      return std::make_unique<PlaneShape>(spec.point, spec.normal, dimension);
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      return make_file_shape(spec, dimension);
    case ShapeKind::union_of:
      return std::make_unique<UnionShape>(make_parts(spec, dimension), dimension);
    case ShapeKind::difference:
      return std::make_unique<DifferenceShape>(make_parts(spec, dimension), dimension);
    case ShapeKind::intersection:
      break;
  }
  return std::make_unique<IntersectionShape>(make_parts(spec, dimension), dimension);
}

}  // namespace scree
