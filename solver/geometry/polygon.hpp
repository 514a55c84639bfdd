// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/geometry/triangle_mesh.hpp"

namespace scree {

/// Adds a polygon of points of the mesh as triangles. Four corners and more may be concave: ears
/// are cut off in the plane of the polygon's area vector.
void add_polygon(TriangleMesh& mesh, const std::vector<std::int32_t>& corners);

}  // namespace scree
