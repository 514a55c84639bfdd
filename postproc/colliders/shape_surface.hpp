// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "postproc/colliders/surface_mesh.hpp"
#include "solver/particles/shape.hpp"

namespace scree {

/// The surface of a shape. Boxes, polygons, meshes and planes are exact, round ones have 96 sides
/// a turn, a terrain is drawn at its raster's centres (at most 1000 a side) without its base, and
/// combinations follow the zero of their distance on a lattice of 800 (2D) or 96 (3D) cells along
/// their longest side.
/// \param domain that bounds what is infinite, m \throws UserError as make_shape
SurfaceMesh shape_surface(const ShapeSpec& spec, int dimension, const Box& domain);

/// The zero of the distance within the box, on a lattice of `cells` along its longest side.
SurfaceMesh contour_2d(const Shape& shape, const Box& box, int cells);
SurfaceMesh contour_3d(const Shape& shape, const Box& box, int cells);

}  // namespace scree
