// SPDX-License-Identifier: Apache-2.0
//
// Triangulated surfaces of known solids, and files of them.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "solver/geometry/triangle_mesh.hpp"

namespace scree::testing {

/// The box in 12 triangles, turned outward.
TriangleMesh box_mesh(const std::array<double, 3>& lower, const std::array<double, 3>& upper);

/// A sphere about the origin: an icosahedron whose triangles are quartered `levels` times, with all
/// points on the sphere.
TriangleMesh icosphere(double radius, int levels);

/// A torus about the z axis; points on the surface, `around` by `across` quadrangles, each halved.
TriangleMesh torus_mesh(double ring, double tube, int around, int across);

/// The plate [x0, x1] x [y0, y1] at height z as an open sheet of count x count squares, halved.
TriangleMesh sheet_mesh(const std::array<double, 2>& lower, const std::array<double, 2>& upper,
                        double z, int count);

/// Both meshes in one.
TriangleMesh joined(TriangleMesh a, const TriangleMesh& b);

std::string ascii_stl(const TriangleMesh& mesh, const std::string& name = "part");
/// `header`: the first bytes, at most 80.
std::string binary_stl(const TriangleMesh& mesh, const std::string& header = "");
std::string obj_text(const TriangleMesh& mesh);
std::string ply_text(const TriangleMesh& mesh);

}  // namespace scree::testing
