// SPDX-License-Identifier: Apache-2.0
#include "materials/registry.hpp"

#include "generated/materials.hpp"

namespace scree {

namespace {

template <Material M>
MaterialEntry make_entry() {
  static const auto schema = M::schema();
  MaterialEntry entry;
  entry.name = M::name;
  entry.schema = &schema;
  entry.fields = M::fields();
  entry.make_input = [] { return std::any(typename M::Input{}); };
  entry.input_pointer = [](std::any& input) -> void* {
    return &std::any_cast<typename M::Input&>(input);
  };
  return entry;
}

}  // namespace

const std::vector<MaterialEntry>& material_registry() {
  static const std::vector<MaterialEntry> registry = [] {
    std::vector<MaterialEntry> entries;
#define SCREE_MATERIAL(header, Type) entries.push_back(make_entry<Type>());
#include "generated/materials.def"
#undef SCREE_MATERIAL
    return entries;
  }();
  return registry;
}

const MaterialEntry* find_material_model(std::string_view name) {
  for (const MaterialEntry& entry : material_registry()) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

}  // namespace scree
