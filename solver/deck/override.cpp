// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/document.hpp"

/// `--set KEY=VALUE`: another value in place of the deck's.
namespace scree {
namespace {

/// The first "=" that does not stand in quotes.
std::size_t equals_sign(const std::string& assignment) {
  char quote = 0;
  for (std::size_t i = 0; i < assignment.size(); ++i) {
    const char c = assignment[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '=') {
      return i;
    }
  }
  return std::string::npos;
}

/// All positions below `value` become that of the option: its name, no line.
void relocate(Value& value, const std::shared_ptr<const std::string>& source) {
  value.position = value.key_position = Position{source, 0, 0};
  for (Value& item : value.items) relocate(item, source);
}

/// The parts of a dotted key, read as TOML reads `key = 0`; nothing when it is no key.
std::optional<std::vector<std::string>> split_key(const std::string& key) {
  Problems ignored;
  const auto document = parse_document(key + " = 0", key, ignored);
  if (!document) return std::nullopt;
  std::vector<std::string> path;
  for (const Value* value = &*document; !value->items.empty(); value = &value->items.front()) {
    path.push_back(value->items.front().key);
  }
  return path;
}

/// The text as a TOML value, or as a text where it is none ("2 s").
Value parse_value(const std::string& text) {
  Problems not_toml;
  const auto parsed = parse_document("v = " + text, text, not_toml);
  if (parsed && parsed->items.size() == 1 && parsed->items.front().key == "v") {
    return parsed->items.front();
  }
  Value value;
  value.kind = Value::Kind::text;
  value.text = text;
  return value;
}

/// The member of that key, made if it is not there.
Value& member(Value& table, const std::string& key,
              const std::shared_ptr<const std::string>& source) {
  if (Value* present = table.find(key)) return *present;
  Value& made = table.items.emplace_back();
  made.key = key;
  relocate(made, source);
  return made;
}

}  // namespace

void apply_override(Value& document, const std::string& assignment, Problems& problems) {
  const auto source = std::make_shared<const std::string>("--set " + assignment);
  const std::size_t equals = equals_sign(assignment);
  if (equals == std::string::npos || equals == 0) {
    problems.add(source_problem(source, "is no assignment",
                                "write --set KEY=VALUE, e.g. --set time.end=0.5"));
    return;
  }
  const auto path = split_key(assignment.substr(0, equals));
  if (!path) {
    problems.add(source_problem(
        source, "has no valid key before the =", "write a dotted key, e.g. time.end"));
    return;
  }
  Value* place = &document;
  std::string walked;
  for (const std::string& key : *path) {
    if (!place->is(Value::Kind::table)) {
      problems.add(source_problem(
          source, walked + " is " + kind_name(place->kind) + ", not a table",
          "set the whole table, e.g. --set '" + walked + "={ " + path->back() + " = ... }'"));
      return;
    }
    place = &member(*place, key, source);
    walked += (walked.empty() ? "" : ".") + key;
  }
  Value value = parse_value(assignment.substr(equals + 1));
  value.key = path->back();
  relocate(value, source);
  *place = std::move(value);
}

}  // namespace scree
