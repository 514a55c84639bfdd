// SPDX-License-Identifier: Apache-2.0
/// \file
/// The material laws of this build, without their C++ types: what the deck reader, the reference
/// text and the output need to know.
#pragma once

#include <any>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "materials/material.hpp"

namespace scree {

/// One line of materials/list.def.
struct MaterialEntry {
  std::string name;                    ///< of the model in the deck
  const SchemaBase* schema = nullptr;  ///< of the law's Input; lives as long as the program
  std::vector<StateField> fields;      ///< of the law's State
  bool effective_stress = false;       ///< may carry pore water
  bool fluid = false;                  ///< stiff against changes of volume only
  std::any (*make_input)() = nullptr;  ///< an Input before any key is read
  void* (*input_pointer)(std::any&) = nullptr;  ///< the Input inside such an any, for the schema
  /// Horizontal over vertical stress at rest, K0, of soil in its natural state with this Input.
  double (*rest_ratio)(const std::any&) = nullptr;
  /// The state in which a body begins under these normal stresses xx, yy, zz [Pa, tension
  /// positive], as the entries of fields; nothing where there is none. Null for laws that leave it
  /// to the elastic stretch of initial_state().
  std::optional<std::vector<double>> (*state_under)(const std::any&,
                                                    const std::array<double, 3>&) = nullptr;
  /// What helps where state_under has no state.
  std::string (*stress_repair)(const std::any&) = nullptr;
  /// What is wrong with this density of the body [kg/m^3]; the key is "density". May be null.
  std::optional<Finding> (*density_fault)(const std::any&, double) = nullptr;
  /// What speaks against averages of its changes of volume (volumetric_locking), or "". stressed:
  /// of a body with initial_stress. May be null.
  std::string (*averaging_doubt)(const std::any&, bool stressed) = nullptr;
  std::optional<InadmissibleText> inadmissible;  ///< in place of the general sentence
};

/// All laws of this build, in the order of materials/list.def.
const std::vector<MaterialEntry>& material_registry();

/// The law of this name, or null.
const MaterialEntry* find_material_model(std::string_view name);

}  // namespace scree
