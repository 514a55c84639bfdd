// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "solver/base/schema.hpp"

/// Reading of tables: which keys belong, which are missing, which checks fail.
namespace scree {
namespace {

std::string child_path(const std::string& path, const std::string& key) {
  return path.empty() ? toml_key(key) : path + "." + toml_key(key);
}

/// The table that a shorthand stands for: `"slip"` -> `{ type = "slip" }`.
Value expand_shorthand(const Value& value, const std::string& key) {
  Value table;
  table.kind = Value::Kind::table;
  table.key = value.key;
  table.key_position = value.key_position;
  table.position = value.position;
  Value member = value;
  member.key = key;
  table.items.push_back(member);
  return table;
}

/// Whether entry is one of the `tag`'s keys; the tag's value as the table (or its default) has it.
bool tag_matches(const Entry& entry, const SchemaBase& schema, const Value& table) {
  const Entry* tag = schema.find(entry.tag);
  const Value* given = table.find(entry.tag);
  const std::string value = given ? given->text : (tag ? tag->fallback_text : std::string());
  const auto& allowed = entry.tag_values;
  const auto is = [&](const std::string& name) {
    return value == name || value == toml_string(name);
  };
  return std::any_of(allowed.begin(), allowed.end(), is);
}

/// True when the tag's value is a known one (else its problem is reported alone).
bool tag_known(const Entry& entry, const SchemaBase& schema, const Value& table) {
  const Entry* tag = schema.find(entry.tag);
  const Value* given = table.find(entry.tag);
  if (!tag) return false;
  if (!given) return !tag->required;
  return std::find(tag->choices.begin(), tag->choices.end(), given->text) != tag->choices.end();
}

std::vector<std::string> available_keys(const SchemaBase& schema, const Value& table,
                                        int dimension) {
  std::vector<std::string> keys;
  for (const auto& entry : schema.entries()) {
    if (entry->dimension != 0 && dimension != 0 && entry->dimension != dimension) continue;
    if (!entry->tag.empty() && !tag_matches(*entry, schema, table)) continue;
    keys.push_back(entry->key);
  }
  return keys;
}

std::string expected_form(const Entry& entry) {
  if (entry.kind == EntryKind::table && entry.nested().text_shorthand().empty()) {
    std::vector<std::string> keys;
    for (const auto& inner : entry.nested().entries()) {
      if (inner->required && inner->tag.empty()) keys.push_back(inner->key + " = ...");
    }
    return entry.key + " = { " + join(keys) + " }";
  }
  if (entry.kind == EntryKind::named) return "[" + entry.key + ".NAME]";
  return entry.key + " = ...";
}

}  // namespace

struct SchemaReader::Scope {
  const SchemaBase& schema;
  void* spec;
  const Value& table;
  std::string path;
};

void SchemaReader::report(const Value& value, const std::string& path, std::string message,
                          std::string allowed, std::string repair) {
  constexpr std::size_t longest = 70;
  std::string text = to_toml(value);
  if (text.size() > longest) text = text.substr(0, longest - 3) + "...";
  const bool absent = value.is(Value::Kind::table) && value.items.empty();
  problems_.add({value.position, path, absent ? std::string() : text, std::move(message),
                 std::move(allowed), std::move(repair)});
}

void SchemaReader::unknown_keys(const Value& table, const std::string& path,
                                const std::vector<std::string>& known) {
  for (const Value& item : table.items) {
    if (std::find(known.begin(), known.end(), item.key) != known.end()) continue;
    const std::string near = did_you_mean(item.key, known);
    Value at_key = item;
    at_key.position = item.key_position;
    report(at_key, child_path(path, item.key), "unknown key", join(known),
           near.empty() ? "remove it" : "did you mean \"" + near + "\"?");
  }
}

bool SchemaReader::available(const Entry& entry, Scope& scope) {
  const Value* value = scope.table.find(entry.key);
  const bool known = context_.dimension != 0;
  if (entry.dimension != 0 && known && entry.dimension != context_.dimension) {
    if (value) {
      report(*value, child_path(scope.path, entry.key),
             "is not available with domain.dimension = " + std::to_string(context_.dimension), "",
             "remove it, or set domain.dimension = " + std::to_string(entry.dimension));
    }
    return false;
  }
  if (entry.tag.empty() || tag_matches(entry, scope.schema, scope.table)) return true;
  // A key may have several entries, one for each kind of meaning: the first reports for all.
  const auto& entries = scope.schema.entries();
  bool twin = false;
  const Entry* first = nullptr;
  std::vector<std::string> tag_values;
  for (const auto& other : entries) {
    if (other->key != entry.key) continue;
    if (!first) first = other.get();
    twin = twin || tag_matches(*other, scope.schema, scope.table);
    tag_values.insert(tag_values.end(), other->tag_values.begin(), other->tag_values.end());
  }
  if (value && !twin && first == &entry && tag_known(entry, scope.schema, scope.table)) {
    const Value* tag = scope.table.find(entry.tag);
    const std::string kind = tag ? to_toml(*tag) : scope.schema.find(entry.tag)->fallback_text;
    report(*value, child_path(scope.path, entry.key),
           "does not belong to " + entry.tag + " = " + kind,
           join(available_keys(scope.schema, scope.table, context_.dimension)),
           "remove it, or set " + entry.tag + " to " + join(tag_values, " or "));
  }
  return false;
}

std::vector<const Value*> SchemaReader::named_tables(const Value& value, const std::string& path) {
  std::vector<const Value*> tables;
  bool bare = !value.is(Value::Kind::table);
  for (const Value& item : value.items) {
    if (item.is(Value::Kind::table) && !bare) tables.push_back(&item);
    bare = bare || !item.is(Value::Kind::table);
  }
  if (!bare) return tables;
  problems_.add({value.position, path, "", "holds values, must hold named tables", "",
                 "write [" + path + ".NAME] with a name of your choice"});
  return {};
}

void SchemaReader::report_missing(const Entry& entry, const Scope& scope) {
  std::string allowed;
  if (!entry.choices.empty()) allowed = join(entry.choices);
  if (entry.unit != Unit::none)
    allowed = with_article(unit_quantity(entry.unit)) + " [" + unit_symbol(entry.unit) + "]";
  std::string repair = "add " + expected_form(entry);
  if (!scope.path.empty()) repair += " to " + scope.path;
  // A misspelt key is reported as such; name it here, too.
  std::vector<std::string> strangers;
  for (const Value& item : scope.table.items) {
    if (!scope.schema.find(item.key)) strangers.push_back(item.key);
  }
  const std::string near = did_you_mean(entry.key, strangers);
  if (!near.empty()) repair = "is it meant by the unknown key \"" + near + "\"?";
  problems_.add({scope.table.position, child_path(scope.path, entry.key), "",
                 "required key is missing", allowed, repair});
}

bool SchemaReader::read_entry(const Entry& entry, Scope& scope) {
  if (!available(entry, scope)) return true;
  const std::size_t before = problems_.size();
  const std::string path = child_path(scope.path, entry.key);
  const Value* value = scope.table.find(entry.key);
  if (value) {
    given_.insert(path);
    entry.read(entry.member(scope.spec), *value, path, *this);
  } else if (entry.required && (entry.dimension == 0 || context_.dimension != 0)) {
    report_missing(entry, scope);
  }
  return problems_.size() == before;
}

void SchemaReader::run_checks(const SchemaBase& schema, const Scope& scope, bool all_right) {
  if (context_.dimension == 0) return;
  const auto right = [&](const std::string& key) {
    return !problems_.any_under(child_path(scope.path, key));
  };
  // First all tests, then the reports: a finding must not silence the next test of its keys.
  std::vector<std::optional<Finding>> findings;
  for (const auto& check : schema.checks()) {
    const auto& keys = check.keys;
    const bool ready = keys.empty() ? all_right : std::all_of(keys.begin(), keys.end(), right);
    if (ready) findings.push_back(check.test(scope.spec, context_));
  }
  for (const auto& finding : findings) {
    if (!finding) continue;
    const Value* value = scope.table.find(finding->key);
    const std::string path =
        finding->key.empty() ? scope.path : child_path(scope.path, finding->key);
    Value absent;
    absent.position = scope.table.position;
    report(value ? *value : absent, path, finding->message, finding->allowed, finding->repair);
  }
}

void SchemaReader::check_keys(const Scope& scope, const std::vector<std::string>& elsewhere) {
  // With a faulty tag nobody knows which keys belong.
  const auto& entries = scope.schema.entries();
  const bool unclear = std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
    return !entry->tag.empty() && scope.table.find(entry->tag) != nullptr &&
           !tag_known(*entry, scope.schema, scope.table);
  });
  if (unclear) return;
  std::vector<std::string> known = available_keys(scope.schema, scope.table, context_.dimension);
  known.insert(known.begin(), elsewhere.begin(), elsewhere.end());
  // Keys that belong to another kind have been reported by available(): they are not unknown.
  Value strangers = scope.table;
  std::erase_if(strangers.items, [&](const Value& item) { return scope.schema.find(item.key); });
  unknown_keys(strangers, scope.path, known);
}

bool SchemaReader::read(const SchemaBase& schema, void* spec, const Value& value,
                        const std::string& path, const std::vector<std::string>& elsewhere) {
  schema.reset(spec, context_);
  if (value.is(Value::Kind::text) && !schema.text_shorthand().empty()) {
    return read(schema, spec, expand_shorthand(value, schema.text_shorthand()), path);
  }
  if (value.is_number() && !schema.number_shorthand().empty()) {
    return read(schema, spec, expand_shorthand(value, schema.number_shorthand()), path);
  }
  if (!value.is(Value::Kind::table)) {
    report(value, path, "is " + kind_name(value.kind) + ", must be a table", join(schema.keys()),
           "write { " + schema.keys().front() + " = ... }");
    return false;
  }
  const std::size_t before = problems_.size();
  Scope scope{schema, spec, value, path};
  for (const auto& entry : schema.entries()) read_entry(*entry, scope);
  check_keys(scope, elsewhere);
  run_checks(schema, scope, problems_.size() == before);
  return problems_.size() == before;
}

}  // namespace scree
