// SPDX-License-Identifier: Apache-2.0
#include "app/reference.hpp"

#include <algorithm>

#include "materials/registry.hpp"
#include "solver/deck/deck.hpp"
#include "solver/element/element_deck.hpp"
#include "solver/simulation/particle_fields.hpp"

namespace scree {
namespace {

std::string with_unit(const std::string& text, Unit unit) {
  if (unit == Unit::angle) return text + " [rad, or \"... deg\"]";  // ranges are in degrees
  const std::string symbol = unit_symbol(unit);
  return symbol.empty() ? text : text + " [" + symbol + "]";
}

std::string count_of(const Entry& entry) {
  return entry.length == 0 ? "d" : std::to_string(entry.length);
}

std::string expression_form(const Entry& entry) {
  const bool one = entry.kind == EntryKind::formula;
  const std::string what =
      one ? "number or expression of " : count_of(entry) + " numbers or expressions of ";
  return with_unit(what + join(entry.variables), entry.unit);
}

/// The form of a value that has no range; empty for the others.
std::string form_without_range(const Entry& entry) {
  switch (entry.kind) {
    case EntryKind::flag:
      return "true, false";
    case EntryKind::text:
      return entry.choices.empty() ? "text" : join(entry.choices);
    case EntryKind::texts:
      return "array of texts";
    case EntryKind::choice:
      return join(entry.choices);
    case EntryKind::points:
      return "array of [x, y] [m]";
    case EntryKind::matrix:
      return "3 rows of 3 numbers";
    case EntryKind::table:
      return "table: see " + entry.nested().name();
    case EntryKind::list:
      return "array of tables: see " + entry.nested().name();
    case EntryKind::named:
      return "tables [" + entry.key + ".NAME]: see " + entry.nested().name();
    default:
      return "";
  }
}

std::string form_of_numbers(const Entry& entry) {
  switch (entry.kind) {
    case EntryKind::integer:
      return "integer";
    case EntryKind::vector:
      return with_unit(count_of(entry) + " numbers", entry.unit);
    case EntryKind::formula:
    case EntryKind::formulas:
      return expression_form(entry);
    default:
      return with_unit("number", entry.unit);
  }
}

}  // namespace

Reference::Reference() {
  collect(deck_schema(), "", false);
  collect(element_schema(), "", false);
}

void Reference::collect(const SchemaBase& schema, const std::string& place, bool model) {
  for (ReferenceSection& section : sections_) {
    if (section.schema != &schema) continue;
    if (std::find(section.places.begin(), section.places.end(), place) == section.places.end()) {
      section.places.push_back(place);
    }
    return;  // nests were collected at the first place
  }
  sections_.push_back({&schema, {place}, model});
  collect_nested(schema, place);
}

void Reference::collect_nested(const SchemaBase& schema, const std::string& place) {
  for (const auto& entry : schema.entries()) {
    if (!entry->nested) continue;
    // A key of the top level is a table of the file; deeper ones are written in braces.
    std::string inner = place.empty() ? "[" + entry->key + "]" : place + " " + entry->key;
    if (entry->kind == EntryKind::named) inner = "[" + entry->key + ".NAME]";
    if (&entry->nested() == &schema) continue;
    collect(entry->nested(), inner, false);
    if (!entry->variants) continue;
    for (const SchemaBase* variant : entry->variants()) {
      collect(*variant, inner + " model = \"" + variant->name() + "\"", true);
    }
  }
}

std::vector<const ReferenceSection*> Reference::find(const std::string& topic) const {
  std::vector<const ReferenceSection*> result;
  for (const ReferenceSection& section : sections_) {
    if (section.schema->name() == topic) result.push_back(&section);
  }
  if (!result.empty()) return result;
  // A key, perhaps with the tables it stands in: the last word counts.
  const std::string key = topic.substr(topic.find_last_of('.') + 1);
  for (const ReferenceSection& section : sections_) {
    const bool named = section.schema->name() == key || section.schema->find(key) != nullptr;
    if (named) result.push_back(&section);
  }
  return result;
}

std::vector<std::string> Reference::topics() const {
  std::vector<std::string> names;
  for (const ReferenceSection& section : sections_) names.push_back(section.schema->name());
  return names;
}

std::vector<std::string> Reference::names() const {
  std::vector<std::string> result = topics();
  for (const ReferenceSection& section : sections_) {
    for (const std::string& key : section.schema->keys()) {
      if (std::find(result.begin(), result.end(), key) == result.end()) result.push_back(key);
    }
  }
  return result;
}

std::vector<Entry> shared_entries(const ReferenceSection& section) {
  std::vector<Entry> entries;
  if (!section.model) return entries;
  for (const auto& entry : material_schema().entries()) {
    const std::vector<std::string>& models = entry->tag_values;
    const bool here =
        std::find(models.begin(), models.end(), section.schema->name()) != models.end();
    if (entry->key == "model" || !(models.empty() || here)) continue;
    entries.push_back(*entry);
    entries.back().tag.clear();  // the section says which model it is
  }
  return entries;
}

std::vector<StateField> output_fields(const ReferenceSection& section) {
  std::vector<StateField> fields;
  if (section.schema == &output_schema()) {
    for (const ParticleField& field : particle_fields()) {
      fields.push_back({field.name, field.components, field.unit, field.doc});
    }
  }
  const MaterialEntry* model =
      section.model ? find_material_model(section.schema->name()) : nullptr;
  if (model == nullptr) return fields;
  for (const StateField& field : model->fields) {
    if (field.output) fields.push_back(field);
  }
  return fields;
}

std::string value_form(const Entry& entry) {
  const std::string form = form_without_range(entry);
  if (!form.empty()) return form;
  const std::string range = range_text(entry);
  return form_of_numbers(entry) + (range.empty() ? "" : ", " + range);
}

std::string default_form(const Entry& entry) {
  return entry.required ? "required" : entry.fallback_text;
}

std::string condition_form(const Entry& entry) {
  std::vector<std::string> parts;
  if (!entry.tag.empty()) parts.push_back(entry.tag + " = " + join(entry.tag_values, " or "));
  if (entry.dimension != 0) parts.push_back("only in " + std::to_string(entry.dimension) + "D");
  return join(parts, ", ");
}

}  // namespace scree
