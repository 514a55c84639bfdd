// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "solver/particles/shape_spec.hpp"

namespace scree {

/// `[traction.NAME]`: a load on those exposed faces of a body's particles whose centres lie in
/// `region` at t = 0. Exactly one of `pressure` and `value` is given. Expressions may use
/// x, y, z (the particle's present position, m), X, Y, Z (its position at t = 0) and t (s).
struct TractionSpec {
  std::string name;
  std::string body;
  ShapeSpec region;
  std::optional<std::string> pressure;              ///< Pa, compression positive; follows the surface
  std::optional<std::array<std::string, 3>> value;  ///< Pa per reference area, fixed direction
};

}  // namespace scree
