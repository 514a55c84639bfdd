// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "solver/particles/shape.hpp"
#include "solver/particles/shape_spec.hpp"

/// Shapes that are read from files: meshes and heightmaps. What has been read is kept as long as
/// the program runs, so that the checks of a deck and the run read a file once.
namespace scree {

/// The first mistake in the spec or its file, or nothing.
std::optional<ShapeProblem> find_file_problem(const ShapeSpec& spec, int dimension);

/// \throws GeometryFault
std::unique_ptr<Shape> make_file_shape(const ShapeSpec& spec, int dimension);

/// m^3, in 2D m^2. \throws GeometryFault
double file_shape_volume(const ShapeSpec& spec, int dimension);

}  // namespace scree
