// SPDX-License-Identifier: Apache-2.0
/// \file
/// The material laws of this build, without their C++ types: what the deck reader, the reference
/// text and the output need to know.
#pragma once

#include <any>
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
  std::any (*make_input)() = nullptr;  ///< an Input before any key is read
  void* (*input_pointer)(std::any&) = nullptr;  ///< the Input inside such an any, for the schema
  /// Horizontal over vertical stress at rest, K0, of soil in its natural state with this Input.
  double (*rest_ratio)(const std::any&) = nullptr;
};

/// All laws of this build, in the order of materials/list.def.
const std::vector<MaterialEntry>& material_registry();

/// The law of this name, or null.
const MaterialEntry* find_material_model(std::string_view name);

}  // namespace scree
