// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "solver/base/schema.hpp"
#include "solver/particles/shape_spec.hpp"

namespace scree {

enum class InitialStressType { geostatic, uniform };

/// `initial_stress` of a body (tension positive).
struct InitialStressSpec {
  InitialStressType type = InitialStressType::uniform;
  double surface = 0;        ///< geostatic: coordinate of the free surface along gravity's axis, m
  std::optional<double> k0;  ///< geostatic: horizontal over vertical stress; not given: the law's
  std::array<double, 3> value{};  ///< uniform: xx, yy, zz, Pa
  bool total = false;             ///< uniform: `value` holds the pore pressure's share too
};

/// `[body.NAME]`: a shape filled with particles of one material.
struct BodySpec {
  std::string name;
  std::string material;
  ShapeSpec shape;
  int particles_per_direction = 3;
  std::array<Formula, 3> velocity{};  ///< m/s, of x, y, z; at t = 0
  std::optional<InitialStressSpec> initial_stress;
};

const Schema<InitialStressSpec>& initial_stress_schema();
const Schema<BodySpec>& body_schema();

}  // namespace scree
