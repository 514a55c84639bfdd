// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape_volume.hpp"

#include <cmath>
#include <numbers>

#include "solver/particles/shape_file.hpp"
#include "solver/particles/shape_polygon.hpp"

namespace scree {
namespace {

double box_volume(const ShapeSpec& spec, int dimension) {
  double volume = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    volume *= spec.upper[a] - spec.lower[a];
  }
  return volume;
}

double cylinder_volume(const ShapeSpec& spec, int dimension) {
  const double length = std::hypot(spec.to[0] - spec.from[0], spec.to[1] - spec.from[1],
                                   dimension == 3 ? spec.to[2] - spec.from[2] : 0.0);
  const double section =
      dimension == 3 ? std::numbers::pi * spec.radius * spec.radius : 2 * spec.radius;
  return section * length;
}

}  // namespace

std::optional<double> exact_volume(const ShapeSpec& spec, int dimension) {
  const double disk = std::numbers::pi * spec.radius * spec.radius;
  switch (spec.kind) {
    case ShapeKind::box:
      return box_volume(spec, dimension);
    case ShapeKind::sphere:
      return dimension == 3 ? disk * spec.radius * 4 / 3 : disk;
    case ShapeKind::cylinder:
      return cylinder_volume(spec, dimension);
    case ShapeKind::polygon:
      return std::abs(signed_area(spec.points)) * (dimension == 3 ? spec.z[1] - spec.z[0] : 1);
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      return file_shape_volume(spec, dimension);
    default:
      return std::nullopt;
  }
}

}  // namespace scree
