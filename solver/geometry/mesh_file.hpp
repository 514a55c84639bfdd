// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/geometry/triangle_mesh.hpp"

namespace scree {

/// Reads the surface in a file by its ending: stl, obj, ply, vtp and vtu here, all else with
/// meshio. Cells of space are replaced by the surface around them, other polygons by triangles.
/// \param region of the file, empty for all of it: a solid of an STL file, an object or group of an
///        OBJ file, a physical group, element or cell set of meshio's formats, "ARRAY=VALUE" or
///        just "VALUE" of the integers on the cells of vtp and vtu
/// \throws GeometryFault
TriangleMesh read_mesh_file(const std::string& path, const std::string& region);

/// The file as one text. \throws GeometryFault if it cannot be read
std::string read_geometry_file(const std::string& path);

/// \throws GeometryFault that says which regions the file has
[[noreturn]] void unknown_region(const std::string& region, std::vector<std::string> known);

/// Binary files are known by their size, whatever their header begins with.
TriangleMesh read_stl(const std::string& path, const std::string& region);

/// Vertices and faces; lines, curves, textures and materials are passed over.
TriangleMesh read_obj(const std::string& path, const std::string& region);

/// PLY (single precision), VTP and VTU through VTK.
TriangleMesh read_with_vtk(const std::string& path, const std::string& region);

/// Everything that Debian's python3-meshio reads, in a process of its own.
TriangleMesh read_with_meshio(const std::string& path, const std::string& region);

}  // namespace scree
