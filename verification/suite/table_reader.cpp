// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/table_reader.hpp"

#include <algorithm>

namespace scree::verify {

const Value* TableReader::any(const std::string& key) {
  known_.push_back(key);
  return table_.find(key);
}

const Value* TableReader::of_kind(const std::string& key,
                                  const std::function<bool(const Value&)>& fits,
                                  const std::string& allowed) {
  const Value* const value = any(key);
  if (value == nullptr || fits(*value)) return value;
  report(*value, key, "is " + kind_name(value->kind), "must be " + allowed);
  return nullptr;
}

std::optional<double> TableReader::number(const std::string& key) {
  const auto fits = [](const Value& v) { return v.is_number(); };
  const Value* const value = of_kind(key, fits, "a number");
  return value != nullptr ? std::optional<double>(value->number()) : std::nullopt;
}

std::optional<bool> TableReader::flag(const std::string& key) {
  const auto fits = [](const Value& v) { return v.is(Value::Kind::boolean); };
  const Value* const value = of_kind(key, fits, "true or false");
  return value != nullptr ? std::optional<bool>(value->boolean) : std::nullopt;
}

std::string TableReader::text(const std::string& key, bool required) {
  const auto fits = [](const Value& v) { return v.is(Value::Kind::text); };
  const Value* const value = of_kind(key, fits, "a text");
  if (value != nullptr) return value->text;
  if (required && !has(key)) report(table_, key, "is missing");
  return {};
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  const auto is_text = [](const Value& v) { return v.is(Value::Kind::text); };
  const auto fits = [&](const Value& v) {
    return is_text(v) ||
           (v.is(Value::Kind::array) && std::all_of(v.items.begin(), v.items.end(), is_text));
  };
  const Value* const value = of_kind(key, fits, "a text or an array of texts");
  std::vector<std::string> result;
  if (value == nullptr) return result;
  if (is_text(*value)) result.push_back(value->text);
  for (const Value& item : value->items) result.push_back(item.text);
  return result;
}

std::vector<double> TableReader::numbers(const std::string& key) {
  const auto is_number = [](const Value& v) { return v.is_number(); };
  const auto fits = [&](const Value& v) {
    return v.is_number() ||
           (v.is(Value::Kind::array) && std::all_of(v.items.begin(), v.items.end(), is_number));
  };
  const Value* const value = of_kind(key, fits, "a number or an array of numbers");
  std::vector<double> result;
  if (value == nullptr) return result;
  if (value->is_number()) result.push_back(value->number());
  for (const Value& item : value->items) result.push_back(item.number());
  return result;
}

std::vector<const Value*> TableReader::tables(const std::string& key, bool required) {
  const auto is_table = [](const Value& v) { return v.is(Value::Kind::table); };
  const auto fits = [&](const Value& v) {
    return v.is(Value::Kind::array) && std::all_of(v.items.begin(), v.items.end(), is_table);
  };
  const Value* const value = of_kind(key, fits, "an array of tables [[" + key + "]]");
  std::vector<const Value*> result;
  if (value != nullptr) {
    for (const Value& item : value->items) result.push_back(&item);
  } else if (required && !has(key)) {
    report(table_, key, "is missing");
  }
  return result;
}

void TableReader::report(const Value& where, const std::string& key, const std::string& message,
                         const std::string& allowed) {
  const std::string whole = path_.empty() ? key : path_ + "." + key;
  const bool plain = !where.is(Value::Kind::table) && !where.is(Value::Kind::array);
  problems_.add({where.position, whole, plain ? to_toml(where) : "", message, allowed, ""});
}

void TableReader::finish() {
  for (const Value& item : table_.items) {
    if (std::find(known_.begin(), known_.end(), item.key) != known_.end()) continue;
    const std::string near = did_you_mean(item.key, known_);
    report(item, item.key, "unknown key",
           "keys: " + join(known_) + (near.empty() ? "" : "; did you mean " + near + "?"));
  }
}

}  // namespace scree::verify
