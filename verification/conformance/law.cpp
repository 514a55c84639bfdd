// SPDX-License-Identifier: Apache-2.0
#include "verification/conformance/law.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "solver/base/problems.hpp"

namespace scree::testing {

// Defined in the units that CMake writes.
#define SCREE_MATERIAL(header, Type)                                        \
  Family family_##header();                                                 \
  std::unique_ptr<LaneLaw<double>> lane_law_##header##_double(std::size_t); \
  std::unique_ptr<LaneLaw<float>> lane_law_##header##_float(std::size_t);
#include "generated/materials.def"
#undef SCREE_MATERIAL

int Law::first_entry(const std::string& field) const {
  int first = 0;
  for (const StateField& f : fields) {
    if (f.name == field) return first;
    first += f.components;
  }
  return -1;
}

int Law::entry_count() const {
  int count = 0;
  for (const StateField& f : fields) count += f.components;
  return count;
}

bool Law::path_independent() const {
  return std::all_of(fields.begin(), fields.end(), [](const StateField& f) {
    return f.name == "deformation_gradient" || f.name == "log_volume_ratio";
  });
}

std::vector<Law> Family::laws() const {
  std::vector<Law> result;
  for (const std::any& input : inputs) {
    result.push_back(make(input));
    result.back().name = name + ", sample " + std::to_string(result.size() - 1);
  }
  return result;
}

std::optional<double> Family::number(const std::any& input, const std::string& key) const {
  const Entry* entry = schema->find(key);
  if (entry == nullptr || entry->kind != EntryKind::number) return std::nullopt;
  std::any copy = input;
  const std::string text = entry->write(entry->member(input_pointer(copy)), 3);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end == text.data()) return std::nullopt;
  return value;
}

std::optional<std::any> Family::changed(const std::any& input, const std::string& key,
                                        double value) const {
  std::any copy = input;
  void* spec = input_pointer(copy);
  const Entry& entry = *schema->find(key);
  Problems problems;
  SchemaReader reader(SchemaContext{}, problems);
  Value number;
  number.kind = Value::Kind::real;
  number.real = value;
  entry.read(entry.member(spec), number, key, reader);
  if (problems.size() > 0) return std::nullopt;
  for (const SchemaBase::Check& check : schema->checks()) {
    if (check.test(spec, SchemaContext{})) return std::nullopt;
  }
  return copy;
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
#define SCREE_MATERIAL(header, Type) list.push_back(family_##header());
#include "generated/materials.def"
#undef SCREE_MATERIAL
    return list;
  }();
  return all;
}

template <>
std::unique_ptr<LaneLaw<double>> make_lane_law(const std::string& name, std::size_t sample) {
#define SCREE_MATERIAL(header, Type) \
  if (name == #header) return lane_law_##header##_double(sample);
#include "generated/materials.def"
#undef SCREE_MATERIAL
  throw std::invalid_argument("no law " + name);
}

template <>
std::unique_ptr<LaneLaw<float>> make_lane_law(const std::string& name, std::size_t sample) {
#define SCREE_MATERIAL(header, Type) \
  if (name == #header) return lane_law_##header##_float(sample);
#include "generated/materials.def"
#undef SCREE_MATERIAL
  throw std::invalid_argument("no law " + name);
}

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Family& family : families()) names.push_back(family.name);
  return names;
}

const Family& find_family(const std::string& name) {
  for (const Family& family : families()) {
    if (family.name == name) return family;
  }
  throw std::invalid_argument("no law " + name);
}

}  // namespace scree::testing
