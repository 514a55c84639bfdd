// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "solver/geometry/triangle_mesh.hpp"
#include "solver/geometry/triangle_tree.hpp"

namespace scree {

/// The solid that a closed triangulated surface encloses. Immutable.
class MeshSolid {
 public:
  /// The direction of the triangles does not matter: inside is what an odd number of surfaces
  /// encloses. Coordinates in m. An open sheet needs `extrusion` (m), see extrude.
  /// \throws GeometryFault if the surface is open, crosses itself or encloses nothing
  explicit MeshSolid(TriangleMesh mesh, const std::array<double, 3>& extrusion = {});
  MeshSolid(const MeshSolid&) = delete;
  MeshSolid& operator=(const MeshSolid&) = delete;

  /// Exact up to rounding of x: parity of a ray's crossings, with exact predicates.
  bool inside(const double x[3]) const { return tree_.odd_crossings(x); }
  /// m, negative inside.
  double signed_distance(const double x[3]) const;
  /// The unit gradient of the signed distance. On the surface: the normal of the face, at edges and
  /// corners the pseudonormal, the sum of the faces' normals weighted with their angles there
  /// (Baerentzen & Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 2005, 243-253).
  void normal(const double x[3], double n[3]) const;

  double volume() const { return volume_; }                             ///< m^3
  const std::array<double, 3>& lower() const { return tree_.lower(); }  ///< m
  const std::array<double, 3>& upper() const { return tree_.upper(); }  ///< m
  const TriangleMesh& mesh() const { return mesh_; }                    ///< turned outward
  std::int64_t turned() const { return turned_; }                       ///< triangles

 private:
  using Point = TriangleMesh::Point;
  static TriangleMesh prepared(TriangleMesh mesh, const std::array<double, 3>& extrusion);
  void find_normals();
  const Point& pseudonormal(const NearestPoint& near) const;

  TriangleMesh mesh_;
  TriangleTree tree_;
  std::int64_t turned_ = 0;
  double volume_ = 0;
  double size_ = 0;                  ///< diagonal of the bounds, m
  std::vector<Point> face_normal_;   ///< unit vectors; zero for a triangle without area
  std::vector<Point> edge_normal_;   ///< three a triangle, unit vectors
  std::vector<Point> point_normal_;  ///< unit vectors
};

}  // namespace scree
