// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace scree {

/// What a viewer draws of a solid. In 3D polygons are its surface; in 2D they fill it, and the
/// lines are its outline.
struct SurfaceMesh {
  using Point = std::array<double, 3>;
  using Cell = std::vector<std::int64_t>;  ///< indices of points

  std::vector<Point> points;  ///< m; z is 0 in 2D
  std::vector<Cell> polygons, lines;

  /// Adds points; returns the index of the first.
  std::int64_t add(const std::vector<Point>& more);
};

/// The part of a plane polygon where (x - point) . outward <= 0, by Sutherland and Hodgman.
std::vector<SurfaceMesh::Point> cut_polygon(const std::vector<SurfaceMesh::Point>& polygon,
                                            const std::array<double, 3>& point,
                                            const std::array<double, 3>& outward);

/// Writes a .vtp file, aside first. Throws RunFault.
void write_mesh(const SurfaceMesh& mesh, const std::string& path);
void write_poly_data(vtkPolyData& data, const std::string& path);

}  // namespace scree
