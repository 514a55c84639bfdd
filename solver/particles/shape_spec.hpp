// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree {

template <class S>
class Schema;

/// The kinds of shape a deck can name. `plane` is the half space behind a plane: a collider or a
/// part of a combination, never a body of its own.
enum class ShapeKind {
  box,
  sphere,
  cylinder,
  polygon,
  plane,
  mesh,
  heightmap,
  union_of,
  difference,
  intersection,
};

/// The deck names of the kinds, in the order of the documentation.
inline const std::vector<std::pair<std::string, ShapeKind>>& shape_kind_names() {
  static const std::vector<std::pair<std::string, ShapeKind>> names{
      {"box", ShapeKind::box},
      {"sphere", ShapeKind::sphere},
      {"cylinder", ShapeKind::cylinder},
      {"polygon", ShapeKind::polygon},
      {"plane", ShapeKind::plane},
      {"mesh", ShapeKind::mesh},
      {"heightmap", ShapeKind::heightmap},
      {"union", ShapeKind::union_of},
      {"difference", ShapeKind::difference},
      {"intersection", ShapeKind::intersection}};
  return names;
}

/// `rotate` of a mesh.
struct RotationSpec {
  std::array<double, 3> axis{0, 0, 1};  ///< through the file's origin, any length > 0
  double angle = 0;                     ///< rad, right-handed
};

/// A shape as the deck states it, lengths in metres. One flat table: which members count depends on
/// `kind`; the others keep their initial value. Vectors have `dimension` entries in the deck and
/// three here, the third 0 in 2D.
struct ShapeSpec {
  ShapeKind kind = ShapeKind::box;

  std::array<double, 3> lower{};   ///< box: lower corner
  std::array<double, 3> upper{};   ///< box: upper corner, above `lower` in every axis
  std::array<double, 3> center{};  ///< sphere
  double radius = 0;               ///< sphere, cylinder: > 0
  std::array<double, 3> from{};    ///< cylinder: centre of the first end
  std::array<double, 3> to{};      ///< cylinder: centre of the other end, != from

  /// polygon: at least three corners in the x-y plane, either sense of rotation, not
  /// self-intersecting; the last is joined to the first.
  std::vector<std::array<double, 2>> points;
  std::array<double, 3> z{};  ///< polygon in 3D: extrusion from z[0] to z[1], z[0] < z[1]

  std::array<double, 3> point{};   ///< plane: any point of it
  std::array<double, 3> normal{};  ///< plane: out of the solid side, any length > 0

  std::string file;                    ///< mesh, heightmap: an absolute path
  std::string region;                  ///< mesh: a part of the file; empty: all of it
  double scale = 1;                    ///< mesh, heightmap: m per unit of the file, > 0
  std::optional<RotationSpec> rotate;  ///< mesh: after scaling
  std::array<double, 3> translate{};   ///< mesh, heightmap: after scaling and turning, m
  std::array<double, 3> extrude{};     ///< mesh: makes an open sheet a solid, m; zero: closed

  double base = 0;                ///< heightmap: height of the flat bottom, m
  std::optional<double> no_data;  ///< heightmap: in place of missing heights, in the file's unit
  /// heightmap in 2D: two points of the map, in the file's unit; empty: the only row
  std::vector<std::array<double, 2>> section;

  /// union, intersection: two or more shapes; difference: the first less all the others.
  std::vector<ShapeSpec> of;
};

const Schema<RotationSpec>& rotation_schema();

/// The keys of a shape; combinations nest in themselves.
const Schema<ShapeSpec>& shape_schema();

}  // namespace scree
