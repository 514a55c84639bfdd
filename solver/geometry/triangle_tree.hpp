// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "solver/geometry/triangle_mesh.hpp"

namespace scree {

/// The part of a triangle on which a nearest point lies.
struct TriangleFeature {
  enum class Kind { face, edge, corner };
  Kind kind = Kind::face;
  int index = 0;  ///< edge i joins the corners i and i + 1
};

/// The nearest point of a mesh.
struct NearestPoint {
  double square = std::numeric_limits<double>::infinity();  ///< of the distance, m^2
  TriangleMesh::Point point{};
  std::int32_t triangle = -1;
  TriangleFeature feature;
};

/// The nearest point of the triangle a, b, c to x, also of one without area.
NearestPoint nearest_on_triangle(const double a[3], const double b[3], const double c[3],
                                 const double x[3]);

/// A hierarchy of boxes around the triangles of a mesh, which it refers to: the mesh must outlive
/// it and keep its points. Queries are safe from any number of threads.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  /// The nearest point of the mesh, of the triangle with the smallest number where several are
  /// equally far.
  NearestPoint nearest(const double x[3]) const;

  /// True if a ray from x along `axis` (0, 1, 2) upwards crosses an odd number of triangles, not
  /// counting triangle `without`: then x is inside a closed surface. A ray through edges and
  /// corners counts as if x were moved by an infinitesimal step, so the answer can only be wrong
  /// where x is within rounding of the surface itself.
  bool odd_crossings(const double x[3], int axis = 0, std::int32_t without = -1) const;

  /// Two triangles that pass through each other or lie on each other, or {-1, -1}; those that
  /// merely touch along a line or in a point are let pass.
  std::pair<std::int32_t, std::int32_t> crossing_pair() const;

  /// True if two triangles lie in one plane, as far as rounding can tell, and have an area in
  /// common.
  bool lie_on_each_other(std::int32_t s, std::int32_t t) const;

  const std::array<double, 3>& lower() const { return nodes_.front().lower; }  ///< m
  const std::array<double, 3>& upper() const { return nodes_.front().upper; }  ///< m

 private:
  struct Node {
    std::array<double, 3> lower, upper;
    std::int32_t first = 0;  ///< leaf: of order_; else: the second child (the first one follows)
    std::int32_t count = 0;  ///< leaf: triangles; 0: not a leaf
  };

  std::int32_t build(std::int32_t first, std::int32_t last, const std::vector<float>& centers);
  void enclose(Node& node, std::int32_t first, std::int32_t last) const;
  bool crosses_ray(std::int32_t triangle, const double x[3], int axis) const;
  std::int32_t crossed_by(std::int32_t triangle) const;
  bool pass_through(std::int32_t s, std::int32_t t) const;
  std::array<const double*, 3> corners(std::int32_t triangle) const {
    return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
  }
  const double* corner(std::int32_t triangle, int i) const {
    return mesh_.points[std::size_t(mesh_.triangles[std::size_t(triangle)][std::size_t(i)])].data();
  }

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace scree
