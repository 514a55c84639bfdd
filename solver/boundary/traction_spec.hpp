// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "solver/base/schema.hpp"
#include "solver/particles/shape_spec.hpp"

namespace scree {

/// `[traction.NAME]`: a load on those exposed faces of a body's particles whose centres lie in
/// `region` at t = 0, rim included. Exactly one of `pressure` and `value` is given. Expressions may
/// use x, y, z (the particle's present position, m), X, Y, Z (its position at t = 0) and t (s).
struct TractionSpec {
  std::string name;
  std::string body;
  ShapeSpec region;
  /// Load only lattice faces whose outward normal lies within 60 degrees of this vector (any
  /// length), so that a region may reach round a corner without loading the other side. Zero: all.
  std::array<double, 3> facing{};
  Formula pressure;              ///< Pa, compression positive; follows the surface
  std::array<Formula, 3> value;  ///< Pa per reference area, fixed direction
};

const Schema<TractionSpec>& traction_schema();

}  // namespace scree
