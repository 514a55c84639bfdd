// SPDX-License-Identifier: Apache-2.0
#include "solver/base/schema.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

const Entry* SchemaBase::find(const std::string& key) const {
  for (const auto& entry : entries_) {
    if (entry->key == key) return entry.get();
  }
  return nullptr;
}

std::vector<std::string> SchemaBase::keys() const {
  std::vector<std::string> result;
  for (const auto& entry : entries_) {
    // A key may have one entry for each kind of a table.
    if (std::find(result.begin(), result.end(), entry->key) == result.end()) {
      result.push_back(entry->key);
    }
  }
  return result;
}

void SchemaBase::reset(void* spec, const SchemaContext& context) const {
  for (const auto& entry : entries_) {
    if (entry->reset) entry->reset(entry->member(spec), context);
  }
}

Entry& SchemaBase::add(std::string key, EntryKind kind, Unit unit) {
  Entry& entry = *entries_.emplace_back(std::make_shared<Entry>());
  entry.key = std::move(key);
  entry.kind = kind;
  entry.unit = unit;
  return entry;
}

std::string write_number(double value) {
  return std::isnan(value) ? std::string() : toml_number(value);
}

std::string write_formula(const Formula& formula) {
  if (!formula.given()) return {};
  const auto quantity = parse_quantity(formula.text);
  return quantity && !quantity->has_unit ? toml_number(quantity->value) : toml_string(formula.text);
}

std::string write_texts(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) {
    result += (result.empty() ? "" : ", ") + toml_string(text);
  }
  return "[" + result + "]";
}

std::string write_points(const std::vector<std::array<double, 2>>& points) {
  std::string result;
  for (const auto& point : points) {
    result += result.empty() ? "[" : ", [";
    result += toml_number(point[0]) + ", " + toml_number(point[1]) + "]";
  }
  return result.empty() ? result : "[" + result + "]";
}

std::string write_matrix(const std::array<double, 9>& matrix) {
  std::string result;
  for (std::size_t i = 0; i < 9; ++i) {
    if (std::isnan(matrix[i])) return {};
    result += i == 0 ? "[[" : i % 3 == 0 ? "], [" : ", ";
    result += toml_number(matrix[i]);
  }
  return result + "]]";
}

std::string write_vector(const Entry& entry, const double* values, int dimension) {
  const int length = entry.length == 0 ? dimension : entry.length;
  std::string result = "[";
  for (int i = 0; i < length; ++i) {
    if (std::isnan(values[i])) return {};
    result += (i == 0 ? "" : ", ") + toml_number(values[i]);
  }
  return result + "]";
}

std::string write_formulas(const Entry& entry, const Formula* formulas, int dimension) {
  const int length = entry.length == 0 ? dimension : entry.length;
  std::string result = "[";
  for (int i = 0; i < length; ++i) {
    if (!formulas[i].given()) return {};
    result += (i == 0 ? "" : ", ") + write_formula(formulas[i]);
  }
  return result + "]";
}

}  // namespace scree
