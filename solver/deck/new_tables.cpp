// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/new_tables.hpp"

#include <algorithm>

namespace scree {
namespace {

std::vector<std::string> table_names(const Value* tables) {
  std::vector<std::string> names;
  if (tables == nullptr) return names;
  for (const Value& item : tables->items) names.push_back(item.key);
  return names;
}

/// The keys that every table of this kind must have and this one lacks.
std::vector<std::string> missing_keys(const Value& table, const SchemaBase& schema) {
  std::vector<std::string> keys;
  for (const auto& entry : schema.entries()) {
    const bool always = entry->required && entry->tag.empty();
    if (always && table.find(entry->key) == nullptr) keys.push_back(entry->key);
  }
  return keys;
}

Problem no_such_table(const Value& table, const std::string& kind,
                      const std::vector<std::string>& names,
                      const std::vector<std::string>& missing) {
  const std::string key = kind + "." + toml_key(table.key);
  const std::string near = did_you_mean(table.key, names);
  const std::string repair =
      near.empty() ? "to make it, set also " + join(missing) : "did you mean \"" + near + "\"?";
  return {table.position, key, "", "there is no [" + key + "]", join(names), repair};
}

}  // namespace

void refuse_incomplete_tables(Value& document, const Value& original, const SchemaBase& schema,
                              Problems& problems) {
  for (const auto& entry : schema.entries()) {
    Value* tables = document.find(entry->key);
    const auto names = table_names(original.find(entry->key));
    if (entry->kind != EntryKind::named || tables == nullptr || names.empty()) continue;
    std::erase_if(tables->items, [&](const Value& item) {
      const bool former = std::find(names.begin(), names.end(), item.key) != names.end();
      if (former || !item.is(Value::Kind::table)) return false;
      const auto missing = missing_keys(item, entry->nested());
      if (missing.empty()) return false;
      problems.add(no_such_table(item, entry->key, names, missing));
      return true;
    });
  }
}

}  // namespace scree
