// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/reference.hpp"
#include "solver/deck/deck.hpp"

/// The reference as a JSON schema (draft 2020-12), for editors that check TOML while typing. What
/// it cannot say (references between tables, places in the domain) only the program checks.
namespace scree {
namespace {

using Json = nlohmann::ordered_json;

/// A number in its SI unit, with its range.
Json number_json(const Entry& entry) {
  Json json{{"type", entry.kind == EntryKind::integer ? "integer" : "number"}};
  if (entry.lower) json[entry.lower_open ? "exclusiveMinimum" : "minimum"] = *entry.lower;
  if (entry.upper) json[entry.upper_open ? "exclusiveMaximum" : "maximum"] = *entry.upper;
  return json;
}

/// A number, or a quoted one with a unit; an expression is any text.
Json quantity_json(const Entry& entry, bool expression) {
  Json text{{"type", "string"}};
  if (!expression) text["pattern"] = "^\\s*[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?.*$";
  return {{"anyOf", Json::array({number_json(entry), text})}};
}

Json array_json(const Entry& entry, const Json& items) {
  Json json{{"type", "array"}, {"items", items}};
  json["minItems"] = entry.length == 0 ? 2 : entry.length;
  json["maxItems"] = entry.length == 0 ? 3 : entry.length;
  return json;
}

Json reference_to(const SchemaBase& schema) { return {{"$ref", "#/$defs/" + schema.name()}}; }

/// Tables under names chosen by the user.
Json named_json(const Entry& entry) {
  Json item = reference_to(entry.nested());
  if (entry.variants) {
    Json choices = Json::array();
    for (const SchemaBase* variant : entry.variants()) choices.push_back(reference_to(*variant));
    item = Json{{"oneOf", choices}};
  }
  return {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", item}};
}

Json enum_json(const std::vector<std::string>& choices) {
  if (choices.empty()) return {{"type", "string"}};
  return {{"enum", choices}};
}

/// Rows of so many numbers; `count` rows, or 0 for three or more.
Json rows_json(const Entry& entry, int columns, int count) {
  Entry row = entry;
  row.length = columns;
  Json json{{"type", "array"}, {"minItems", 3}};
  if (count > 0) json["maxItems"] = count;
  json["items"] = array_json(row, quantity_json(row, false));
  return json;
}

Json value_json(const Entry& entry) {
  switch (entry.kind) {
    case EntryKind::number:
      return quantity_json(entry, false);
    case EntryKind::integer:
      return number_json(entry);
    case EntryKind::flag:
      return {{"type", "boolean"}};
    case EntryKind::texts:
      return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case EntryKind::text:
    case EntryKind::choice:
      return enum_json(entry.choices);
    case EntryKind::vector:
      return array_json(entry, quantity_json(entry, false));
    case EntryKind::formula:
      return quantity_json(entry, true);
    case EntryKind::formulas:
      return array_json(entry, quantity_json(entry, true));
    case EntryKind::points:
      return rows_json(entry, 2, 0);
    case EntryKind::matrix:
      return rows_json(entry, 3, 3);
    case EntryKind::table:
      return reference_to(entry.nested());
    case EntryKind::list:
      return {{"type", "array"}, {"minItems", 1}, {"items", reference_to(entry.nested())}};
    case EntryKind::named:
      return named_json(entry);
  }
  return Json::object();
}

std::string description(const Entry& entry) {
  std::string text = entry.doc;
  const std::string symbol = unit_symbol(entry.unit);
  if (!symbol.empty()) text += " [" + symbol + "]";
  if (!entry.required) text += " Default: " + default_form(entry) + ".";
  const std::string condition = condition_form(entry);
  return condition.empty() ? text : text + " Only with " + condition + ".";
}

/// Rules of the keys that depend on a tag: for each of its values, which are needed and which are
/// out of place.
Json tag_rules(const SchemaBase& schema, const Entry& tag) {
  Json rules = Json::array();
  for (const std::string& value : tag.choices) {
    Json required = Json::array(), forbidden = Json::object();
    for (const auto& entry : schema.entries()) {
      if (entry->tag != tag.key) continue;
      const auto& values = entry->tag_values;
      const bool here = std::find(values.begin(), values.end(), value) != values.end();
      if (here) {
        forbidden.erase(entry->key);
        if (entry->required && entry->dimension == 0) required.push_back(entry->key);
      } else if (std::none_of(schema.entries().begin(), schema.entries().end(), [&](const auto& e) {
                   const auto& v = e->tag_values;
                   return e->key == entry->key && std::find(v.begin(), v.end(), value) != v.end();
                 })) {
        forbidden[entry->key] = false;
      }
    }
    Json condition{{"properties", {{tag.key, {{"const", value}}}}}};
    // Without the tag its default holds.
    const bool is_default = !tag.required && tag.fallback_text == toml_string(value);
    if (!is_default) condition["required"] = {tag.key};
    Json then = Json::object();
    if (!required.empty()) then["required"] = required;
    if (!forbidden.empty()) then["properties"] = forbidden;
    if (!then.empty()) rules.push_back({{"if", condition}, {"then", then}});
  }
  return rules;
}

/// The properties and requirements of a table.
Json table_json(const SchemaBase& schema) {
  Json properties = Json::object(), required = Json::array(), rules = Json::array();
  for (const auto& entry : schema.entries()) {
    Json property = value_json(*entry);
    property["description"] = description(*entry);
    if (properties.contains(entry->key)) {
      property = Json{{"anyOf", Json::array({properties[entry->key], property})}};
    }
    properties[entry->key] = property;
    const bool always = entry->tag.empty() && entry->dimension == 0;
    if (entry->required && always) required.push_back(entry->key);
    for (Json& rule : tag_rules(schema, *entry)) rules.push_back(std::move(rule));
  }
  Json json{{"type", "object"}, {"description", schema.doc()}, {"properties", properties}};
  if (!required.empty()) json["required"] = required;
  if (!rules.empty()) json["allOf"] = rules;
  json["additionalProperties"] = false;
  return json;
}

/// A model's table also has the keys that all materials have.
Json model_json(const SchemaBase& model) {
  Json json = table_json(model);
  const Json common = table_json(material_schema());
  for (const auto& [key, property] : common["properties"].items()) {
    const std::vector<std::string>& models = material_schema().find(key)->tag_values;
    const bool known = std::find(models.begin(), models.end(), model.name()) != models.end();
    if (models.empty() || known) json["properties"][key] = property;
  }
  json["properties"]["model"] = {{"const", model.name()}};
  for (const auto& key : common["required"]) json["required"].push_back(key);
  return json;
}

Json definition(const ReferenceSection& section) {
  const SchemaBase& schema = *section.schema;
  Json json = section.model ? model_json(schema) : table_json(schema);
  Json forms = Json::array({json});
  const auto& text_key = schema.text_shorthand();
  const auto& number_key = schema.number_shorthand();
  if (!text_key.empty()) forms.push_back(value_json(*schema.find(text_key)));
  if (!number_key.empty()) forms.push_back(value_json(*schema.find(number_key)));
  return forms.size() == 1 ? json : Json{{"anyOf", forms}};
}

}  // namespace

std::string reference_json_schema(const Reference& reference) {
  Json json{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "scree deck"}};
  json.update(table_json(deck_schema()));
  json["$defs"] = Json::object();
  for (const ReferenceSection& section : reference.sections()) {
    if (section.schema == &deck_schema()) continue;
    if (section.schema == &material_schema()) continue;  // part of every model
    json["$defs"][section.schema->name()] = definition(section);
  }
  return json.dump(2) + "\n";
}

}  // namespace scree
