// SPDX-License-Identifier: Apache-2.0
#include "materials/typical_input.hpp"

#include "solver/base/error.hpp"

namespace scree {

void set_typical_values(const SchemaBase& schema, void* input, int dimension,
                        const NumberKeys& values) {
  Value table;
  const auto add = [&](const std::string& key, double number) {
    Value& item = table.items.emplace_back();
    item.kind = Value::Kind::real;
    item.real = number;
    item.key = key;
  };
  for (const auto& [key, number] : values) add(key, number);
  for (const auto& entry : schema.entries()) {
    if (entry->typical && table.find(entry->key) == nullptr) add(entry->key, *entry->typical);
  }
  SchemaContext context;
  context.dimension = dimension;
  Problems problems;
  SchemaReader reader(context, problems);
  if (!reader.read(schema, input, table, "")) {
    throw UserError("typical values of " + schema.name() + ": " + problems.text());
  }
}

std::any typical_input(const MaterialEntry& entry, int dimension, const NumberKeys& values) {
  std::any input = entry.make_input();
  set_typical_values(*entry.schema, entry.input_pointer(input), dimension, values);
  return input;
}

}  // namespace scree
