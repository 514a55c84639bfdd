// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/geometry/triangle_mesh.hpp"
#include "solver/geometry/triangle_tree.hpp"

/// From the triangles of a file to a surface that bounds a solid, step by step.
namespace scree {

/// A side of a triangle: the points in ascending order.
struct MeshEdge {
  std::int32_t low, high;
  std::int32_t triangle;
  int side;  ///< side i joins the corners i and i + 1
  bool same_points(const MeshEdge& other) const { return low == other.low && high == other.high; }
};

/// All sides of all triangles, those of the same points one after the other.
std::vector<MeshEdge> sorted_edges(const TriangleMesh& mesh);

/// Makes points with the same coordinates one (files such as STL repeat them), and drops triangles
/// of which two corners are one, and points without a triangle.
/// \throws GeometryFault if a coordinate is not finite, or no triangle is left
void merge_points(TriangleMesh& mesh);

/// Two triangles of the same three points enclose nothing between them: both go.
/// \throws GeometryFault if nothing is left
void drop_twins(TriangleMesh& mesh);

/// Makes an open sheet the solid between itself and its copy moved by `step` (m).
/// \throws GeometryFault if the sheet has no rim
void extrude(TriangleMesh& mesh, const std::array<double, 3>& step);

/// \throws GeometryFault that names the first open edge, if there is any
void check_closed(const TriangleMesh& mesh);

/// \throws GeometryFault that names the place where the surface passes through itself
void check_crossings(const TriangleMesh& mesh, const TriangleTree& tree);

/// Turns the triangles of a closed surface so that their corners run counter-clockwise seen from
/// outside, where the solid is what an odd number of surfaces encloses: the second surface inwards
/// bounds a cavity. Returns how many were turned.
std::int64_t turn_outward(TriangleMesh& mesh, const TriangleTree& tree);

}  // namespace scree
