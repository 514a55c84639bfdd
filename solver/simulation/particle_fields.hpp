// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace scree {

/// What a field of particles that every law has is worth.
enum class FieldQuantity {
  velocity,
  stress,
  effective_stress,
  pressure,
  p,
  q,
  lode_angle,
  principal_stress,
  principal_directions,
  mobilised_friction,
  yield_distance,
  equivalent_plastic_shear_strain,
  strain_rate,
  mass,
  volume,
  volume_ratio,
  displacement,
  state  ///< not of this list: of the material
};

/// A field that can be asked for whatever the materials are.
struct ParticleField {
  std::string name;
  std::string unit;  ///< SI symbol, "1" where dimensionless
  int components = 1;
  FieldQuantity quantity;
  std::string doc;          ///< meaning, sign and range
  bool pore_water = false;  ///< only where a material has pore water
};

/// All of them, in the order of the reference. Stresses they follow from are effective.
const std::vector<ParticleField>& particle_fields();

}  // namespace scree
