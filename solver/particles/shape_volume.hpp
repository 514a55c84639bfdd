// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "solver/particles/shape_spec.hpp"

namespace scree {

/// The volume of a box, sphere, cylinder, polygon, mesh or heightmap, m^3; in 2D the area, m^2.
/// Nothing for a plane and for combinations, which have no simple formula.
std::optional<double> exact_volume(const ShapeSpec& spec, int dimension);

}  // namespace scree
