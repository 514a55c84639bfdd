// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/deck/deck.hpp"

namespace scree {

/// Acceleration that turns a hydraulic conductivity into a permeability [m/s^2].
inline constexpr double conductivity_gravity = 9.81;

/// `porosity` and the keys that need it.
const std::vector<std::string>& pore_key_names();

/// The keys of a material whose pores hold water that flows; `models`: those that may have it.
void add_pore_keys(Schema<MaterialSpec>& schema, const std::vector<std::string>& models);

}  // namespace scree
