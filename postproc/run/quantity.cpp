// SPDX-License-Identifier: Apache-2.0
#include "postproc/run/quantity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "solver/base/error.hpp"
#include "solver/base/problems.hpp"

namespace scree {
namespace {

using Kind = ParticleQuantity::Kind;

constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
constexpr std::array<const char*, 9> tensor = {"xx", "xy", "xz", "yx", "yy",
                                               "yz", "zx", "zy", "zz"};

FieldInfo find_field(const std::string& name, const std::vector<FieldInfo>& fields) {
  if (name == "position") return {"position", 3};
  std::vector<std::string> names;
  for (const FieldInfo& field : fields) {
    if (field.name == name) return field;
    names.push_back(field.name);
  }
  names.push_back("position");
  const std::string near = did_you_mean(name, names);
  throw UserError("there is no field " + name + "; the frames have " + join(names) +
                  (near.empty() ? "" : "; did you mean " + near + "?"));
}

/// Everything that a field can be asked for, in the order of columns.
std::vector<ParticleQuantity> all_of(const FieldInfo& field) {
  const std::string unit = unit_of_field(field.name);
  if (field.components == 1) return {{field.name, unit, field.name, 0, Kind::component}};
  std::vector<ParticleQuantity> result;
  for (int c = 0; c < field.components; ++c) {
    const auto index = static_cast<std::size_t>(c);
    const std::string part = field.components == 3   ? axes[index]
                             : field.components == 9 ? tensor[index]
                                                     : std::to_string(c);
    result.push_back({field.name + "." + part, unit, field.name, c, Kind::component});
  }
  if (field.components == 3) {
    result.push_back({field.name + ".magnitude", unit, field.name, -1, Kind::magnitude});
  }
  if (field.components == 9) {
    result.push_back({field.name + ".p", unit, field.name, -1, Kind::mean_pressure});
    result.push_back({field.name + ".q", unit, field.name, -1, Kind::deviatoric});
    result.push_back({field.name + ".von_mises", unit, field.name, -1, Kind::deviatoric});
  }
  return result;
}

/// Columns of a whole field: what is not zero or a repetition in every run of this dimension.
bool shown(const ParticleQuantity& quantity, const FieldInfo& field, int dimension) {
  if (quantity.kind != Kind::component) return quantity.kind == Kind::magnitude;
  const int c = quantity.component;
  if (field.components == 3) return c < dimension;
  if (field.components != 9) return true;
  const int row = c / 3, column = c % 3;
  if (row > column) return false;
  return dimension == 3 || row == column || (row < 2 && column < 2);
}

const SnapshotField& field_of(const ParticleSnapshot& snapshot, const std::string& name) {
  for (const SnapshotField& field : snapshot.fields) {
    if (field.name == name) return field;
  }
  throw std::logic_error("field " + name + " was not read");
}

double evaluate(const ParticleQuantity& quantity, const double* v, int components) {
  switch (quantity.kind) {
    case Kind::component:
      return v[quantity.component];
    case Kind::magnitude: {
      double square = 0;
      for (int c = 0; c < components; ++c) square += v[c] * v[c];
      return std::sqrt(square);
    }
    case Kind::mean_pressure:
      return -(v[0] + v[4] + v[8]) / 3;
    case Kind::deviatoric: {
      const double mean = (v[0] + v[4] + v[8]) / 3;
      double square = 0;
      for (int c = 0; c < 9; ++c) {
        const double s = v[c] - (c % 4 == 0 ? mean : 0);
        square += s * s;
      }
      return std::sqrt(1.5 * square);
    }
  }
  return 0;
}

}  // namespace

std::vector<ParticleQuantity> quantities(const std::string& word,
                                         const std::vector<FieldInfo>& fields, int dimension) {
  const std::size_t dot = word.find('.');
  const FieldInfo field = find_field(word.substr(0, dot), fields);
  std::vector<ParticleQuantity> result;
  std::vector<std::string> parts;
  for (const ParticleQuantity& quantity : all_of(field)) {
    if (dot == std::string::npos ? shown(quantity, field, dimension) : quantity.name == word) {
      result.push_back(quantity);
    }
    const std::size_t at = quantity.name.find('.');
    if (at != std::string::npos) parts.push_back(quantity.name.substr(at + 1));
  }
  if (result.empty()) {
    throw UserError(
        parts.empty()
            ? field.name + " is a single number and has no component " + word.substr(dot + 1)
            : field.name + " has no component " + word.substr(dot + 1) + "; it has " + join(parts));
  }
  return result;
}

std::vector<ParticleQuantity> quantities(const std::vector<std::string>& words,
                                         const std::vector<FieldInfo>& fields, int dimension) {
  std::vector<ParticleQuantity> result;
  for (const std::string& word : words) {
    for (const ParticleQuantity& quantity : quantities(word, fields, dimension)) {
      result.push_back(quantity);
    }
  }
  return result;
}

std::vector<ParticleQuantity> default_quantities(const std::vector<FieldInfo>& fields,
                                                 int dimension) {
  const auto has = [&](const std::string& name) {
    return std::any_of(fields.begin(), fields.end(),
                       [&](const FieldInfo& field) { return field.name == name; });
  };
  std::vector<std::string> words;
  if (has("velocity")) words.push_back("velocity.magnitude");
  for (const auto& [field, word] : {std::pair{"pressure", "pressure"}, {"stress", "stress.p"}}) {
    if (!has(field)) continue;
    words.push_back(word);
    break;
  }
  if (words.empty() && !fields.empty()) words.push_back(fields.front().name);
  if (words.empty()) throw UserError("the frames hold no fields; ask for some in output.fields");
  return quantities(words, fields, dimension);
}

std::vector<std::string> needed_fields(const std::vector<ParticleQuantity>& quantities) {
  std::vector<std::string> result;
  for (const ParticleQuantity& quantity : quantities) {
    const bool known = std::find(result.begin(), result.end(), quantity.field) != result.end();
    if (quantity.field != "position" && !known) result.push_back(quantity.field);
  }
  return result;
}

std::vector<double> values_of(const ParticleQuantity& quantity, const ParticleSnapshot& snapshot) {
  const bool place = quantity.field == "position";
  const SnapshotField* field = place ? nullptr : &field_of(snapshot, quantity.field);
  const int components = place ? 3 : field->components;
  const std::vector<double>& values = place ? snapshot.position : field->values;
  std::vector<double> result(snapshot.id.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = evaluate(quantity, &values[i * static_cast<std::size_t>(components)], components);
  }
  return result;
}

std::string unit_of_field(const std::string& name) {
  static const std::vector<std::pair<std::string, std::string>> units = {
      {"position", "m"},
      {"displacement", "m"},
      {"velocity", "m/s"},
      {"seepage_velocity", "m/s"},
      {"stress", "Pa"},
      {"effective_stress", "Pa"},
      {"pressure", "Pa"},
      {"pore_pressure", "Pa"},
      {"preconsolidation_pressure", "Pa"},
      {"p", "Pa"},
      {"q", "Pa"},
      {"von_mises", "Pa"},
      {"principal_stress", "Pa"},
      {"lode_angle", "rad"},
      {"mobilised_friction", "rad"},
      {"strain_rate", "1/s"},
      {"mass", "kg"},
      {"volume", "m^3"}};
  for (const auto& [known, unit] : units) {
    if (known == name) return unit;
  }
  return "";
}

}  // namespace scree
