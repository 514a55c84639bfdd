// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/problems.hpp"

namespace scree {

/// A value of an input document with its position: what a deck is made of, whatever wrote it.
struct Value {
  enum class Kind { boolean, integer, real, text, array, table, other };

  Kind kind = Kind::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;          ///< of a text; of a number or date as written, if known
  std::vector<Value> items;  ///< of an array: its entries; of a table: its members
  std::string key;           ///< of a table's member: its key
  Position key_position;     ///< where the key stands
  Position position;         ///< where the value stands

  bool is(Kind other) const { return kind == other; }
  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
  /// The number of an integer or a real.
  double number() const { return kind == Kind::integer ? static_cast<double>(integer) : real; }
  /// A table's member or nullptr.
  const Value* find(const std::string& member) const;
  Value* find(const std::string& member);
};

/// "an integer", "a table", ...
std::string kind_name(Value::Kind kind);

/// The value as TOML on one line.
std::string to_toml(const Value& value);

/// Shortest TOML text that reads back to the same double ("1600.0", "1e-05").
std::string toml_number(double value);
/// A TOML basic string with escapes.
std::string toml_string(const std::string& text);
/// A TOML key, quoted if it must be.
std::string toml_key(const std::string& key);

}  // namespace scree
