// SPDX-License-Identifier: Apache-2.0
#include "solver/base/value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace scree {

const Value* Value::find(const std::string& member) const {
  for (const Value& item : items) {
    if (kind == Kind::table && item.key == member) return &item;
  }
  return nullptr;
}

Value* Value::find(const std::string& member) {
  return const_cast<Value*>(static_cast<const Value*>(this)->find(member));
}

std::string kind_name(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::boolean:
      return "a boolean";
    case Value::Kind::integer:
      return "an integer";
    case Value::Kind::real:
      return "a number";
    case Value::Kind::text:
      return "a text";
    case Value::Kind::array:
      return "an array";
    case Value::Kind::table:
      return "a table";
    case Value::Kind::other:
      return "a date or time";
  }
  return "a value";
}

std::string toml_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  (void)error;  // 32 bytes hold every shortest double
  std::string text(buffer, end);
  // TOML: a real has a point or an exponent.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (code < 0x20 || code == 0x7f) {
      char buffer[8];
      std::snprintf(buffer, sizeof buffer, "\\u%04x", code);
      result += buffer;
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string toml_key(const std::string& key) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), bare) ? key : toml_string(key);
}

std::string to_toml(const Value& value) {
  switch (value.kind) {
    case Value::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Value::Kind::integer:
      return value.text.empty() ? std::to_string(value.integer) : value.text;
    case Value::Kind::real:
      return value.text.empty() ? toml_number(value.real) : value.text;
    case Value::Kind::text:
      return toml_string(value.text);
    case Value::Kind::other:
      return value.text;
    default:
      break;
  }
  const bool table = value.is(Value::Kind::table);
  std::string text;
  for (const Value& item : value.items) {
    if (!text.empty()) text += ", ";
    if (table) text += toml_key(item.key) + " = ";
    text += to_toml(item);
  }
  if (!table) return "[" + text + "]";
  return text.empty() ? "{}" : "{ " + text + " }";
}

}  // namespace scree
