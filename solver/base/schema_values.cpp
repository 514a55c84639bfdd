// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "solver/base/schema.hpp"

/// Reading of single values: kinds, units, ranges, names, expressions.
namespace scree {
namespace {

std::string number_form(const Entry& entry) {
  const std::string symbol = unit_symbol(entry.unit);
  if (symbol.empty()) return "a number";
  return "a number in " + symbol + " or a quoted number with a unit (" + unit_examples(entry.unit) +
         ")";
}

std::vector<std::string> example_units(Unit unit) {
  std::vector<std::string> result(1);
  for (const char c : unit_examples(unit)) {
    if (c == ',') {
      result.emplace_back();
    } else if (c != ' ' || !result.back().empty()) {
      result.back() += c;
    }
  }
  return result;
}

/// What to do about a quantity of the wrong dimension.
std::string dimension_repair(const Entry& entry, const Quantity& quantity) {
  const Dimension weight_density{-2, 1, -2, 0};
  if (entry.unit == Unit::density && quantity.dimension == weight_density) {
    const double density = std::round(quantity.value / 9.81 * 10) / 10;
    return "this is a weight per volume; divide it by g = 9.81 m/s^2: \"" + toml_number(density) +
           " kg/m^3\"";
  }
  const std::string symbol = unit_symbol(entry.unit);
  if (symbol.empty()) return "write the number without a unit";
  return "write it in " + symbol;
}

/// The text with a decimal point in place of its comma when that makes it a quantity ("5,0 mm"),
/// else "".
std::string with_decimal_point(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return "";
  text[comma] = '.';
  return parse_quantity(text) ? text : "";
}

std::string decimal_repair(const Value& value) {
  const std::string mended = with_decimal_point(value.text);
  return mended.empty() ? "" : "write a decimal point: " + toml_string(mended);
}

/// A stress in mPa is a slip of the shift key; the prefix is there for viscosities. Returns what
/// was meant, or "".
std::string meant_by_millipascal(const Entry& entry, const Quantity& quantity, std::string text) {
  const bool stress =
      entry.unit == Unit::pressure && quantity.dimension == dimension_of(entry.unit);
  const std::size_t place = text.find("mPa");
  if (!stress || place == std::string::npos) return "";
  return text.replace(place, 1, "M");
}

}  // namespace

std::string range_text(const Entry& entry) {
  const auto bound = [&](double x) {
    if (entry.unit == Unit::angle) {
      const double degrees = x * 180 / std::acos(-1.0);
      std::string text = toml_number(std::round(degrees * 1e6) / 1e6);
      if (text.ends_with(".0")) text.resize(text.size() - 2);
      return text + " deg";
    }
    std::string text = toml_number(x);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    const std::string symbol = unit_symbol(entry.unit);
    return symbol.empty() ? text : text + " " + symbol;
  };
  std::string text;
  if (entry.lower) text = (entry.lower_open ? "above " : "at least ") + bound(*entry.lower);
  if (entry.upper) {
    if (!text.empty()) text += " and ";
    text += (entry.upper_open ? "below " : "at most ") + bound(*entry.upper);
  }
  return text;
}

bool SchemaReader::in_range(const Entry& entry, double x, const Value& value,
                            const std::string& path, bool has_unit) {
  const bool low = entry.lower && (entry.lower_open ? x <= *entry.lower : x < *entry.lower);
  const bool high = entry.upper && (entry.upper_open ? x >= *entry.upper : x > *entry.upper);
  if (!low && !high) return true;
  std::string repair;
  if (entry.unit == Unit::angle && !has_unit && high) {
    repair = "a bare number is in radians; for degrees write \"" + to_toml(value) + " deg\"";
    if (value.is(Value::Kind::text)) repair = "a bare number is in radians; add \"deg\"";
  }
  report(value, path, low ? "is too small" : "is too large", range_text(entry), repair);
  return false;
}

bool SchemaReader::quantity(const Entry& entry, const Value& value, const std::string& path,
                            Quantity& result) {
  const auto parsed = parse_quantity(value.text);
  if (!parsed) {
    report(value, path, "is not a number with a unit", number_form(entry), decimal_repair(value));
    return false;
  }
  if (!parsed->unknown_unit.empty()) {
    const std::string near = did_you_mean(parsed->unknown_unit, example_units(entry.unit));
    report(value, path, "has the unknown unit \"" + parsed->unknown_unit + "\"",
           unit_examples(entry.unit), near.empty() ? "" : "did you mean \"" + near + "\"?");
    return false;
  }
  if (parsed->has_unit && parsed->dimension != dimension_of(entry.unit)) {
    const std::string quantity_name = unit_quantity(entry.unit);
    report(value, path, "has a unit that is not of " + with_article(quantity_name),
           unit_examples(entry.unit), dimension_repair(entry, *parsed));
    return false;
  }
  if (const auto meant = meant_by_millipascal(entry, *parsed, value.text); !meant.empty()) {
    report(value, path, "is in thousandths of a pascal", unit_examples(entry.unit),
           "did you mean " + toml_string(meant) + "?");
    return false;
  }
  result = *parsed;
  return true;
}

bool SchemaReader::number(const Entry& entry, const Value& value, const std::string& path,
                          double& result) {
  Quantity read;
  if (value.is_number()) {
    read.value = value.number();
  } else if (value.is(Value::Kind::text)) {
    if (!quantity(entry, value, path, read)) return false;
  } else {
    report(value, path, "is " + kind_name(value.kind) + ", must be a number", number_form(entry));
    return false;
  }
  if (!std::isfinite(read.value)) {
    report(value, path, "is not finite", range_text(entry), "write a finite number");
    return false;
  }
  if (!in_range(entry, read.value, value, path, read.has_unit)) return false;
  result = read.value;
  return true;
}

bool SchemaReader::integer(const Entry& entry, const Value& value, const std::string& path,
                           int& result) {
  if (!value.is(Value::Kind::integer)) {
    report(value, path, "is " + kind_name(value.kind) + ", must be an integer", range_text(entry));
    return false;
  }
  if (!in_range(entry, static_cast<double>(value.integer), value, path, false)) return false;
  if (value.integer > std::numeric_limits<int>::max() ||
      value.integer < std::numeric_limits<int>::min()) {
    report(value, path, "does not fit a 32-bit integer", range_text(entry));
    return false;
  }
  result = static_cast<int>(value.integer);
  return true;
}

bool SchemaReader::flag(const Value& value, const std::string& path, bool& result) {
  if (!value.is(Value::Kind::boolean)) {
    report(value, path, "is " + kind_name(value.kind) + ", must be a boolean", "true, false");
    return false;
  }
  result = value.boolean;
  return true;
}

bool SchemaReader::text(const Value& value, const std::string& path, std::string& result) {
  if (!value.is(Value::Kind::text)) {
    report(value, path, "is " + kind_name(value.kind) + ", must be a text", "",
           "write it in quotes");
    return false;
  }
  result = value.text;
  return true;
}

bool SchemaReader::texts(const Value& value, const std::string& path,
                         std::vector<std::string>& result) {
  if (!value.is(Value::Kind::array)) {
    report(value, path, "is " + kind_name(value.kind) + ", must be an array of texts", "",
           "write [ \"...\" ]");
    return false;
  }
  std::vector<std::string> read(value.items.size());
  bool good = true;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const std::string item_path = path + "[" + std::to_string(i) + "]";
    good = text(value.items[i], item_path, read[i]) && good;
  }
  if (good) result = std::move(read);
  return good;
}

int SchemaReader::choice(const Entry& entry, const Value& value, const std::string& path) {
  if (!value.is(Value::Kind::text)) {
    report(value, path, "is " + kind_name(value.kind) + ", must be one of the names",
           join(entry.choices));
    return -1;
  }
  for (std::size_t i = 0; i < entry.choices.size(); ++i) {
    if (entry.choices[i] == value.text) return static_cast<int>(i);
  }
  for (const std::string& name : entry.later) {
    if (name != value.text) continue;
    report(value, path, "not available in this version; available: " + join(entry.choices));
    return -1;
  }
  const std::string near = did_you_mean(value.text, entry.choices);
  report(value, path, "unknown name", join(entry.choices),
         near.empty() ? "" : "did you mean \"" + near + "\"?");
  return -1;
}

bool SchemaReader::has_length(const Entry& entry, const Value& value, const std::string& path,
                              const std::string& what) {
  const int length = entry.length == 0 ? context_.dimension : entry.length;
  const auto found = static_cast<int>(value.items.size());
  const bool array = value.is(Value::Kind::array);
  // A faulty domain.dimension is reported alone: vectors of both lengths may be right.
  if (length == 0 && array && (found == 2 || found == 3)) return true;
  if (array && found == length) return true;
  const std::string wanted = length == 0 ? std::string("2 or 3") : std::to_string(length);
  const std::string source = entry.length == 0 ? " (domain.dimension)" : "";
  std::string repair;
  if (array && !source.empty() && length == 2 && found == 3) {
    repair = "remove the third entry, or set domain.dimension = 3";
  }
  report(value, path,
         array ? "has " + std::to_string(found) + " entries"
               : "is " + kind_name(value.kind) + ", must be an array",
         wanted + " " + what + source, repair);
  return false;
}

bool SchemaReader::vector(const Entry& entry, const Value& value, const std::string& path,
                          double* result) {
  if (!has_length(entry, value, path, "numbers")) return false;
  double read[3] = {0, 0, 0};
  bool good = true;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    good = number(entry, value.items[i], path + "[" + std::to_string(i) + "]", read[i]) && good;
  }
  if (!good) return false;
  for (int i = 0; i < 3; ++i) result[i] = read[i];
  return true;
}

bool SchemaReader::formula(const Entry& entry, const Value& value, const std::string& path,
                           Formula& result) {
  const bool expression = value.is(Value::Kind::text) && !parse_quantity(value.text);
  if (!expression) {
    double x = 0;
    if (!number(entry, value, path, x)) return false;
    result.text = toml_number(x);
    return true;
  }
  if (const std::string repair = decimal_repair(value); !repair.empty()) {
    report(value, path, "is no number", number_form(entry), repair);
    return false;
  }
  if (context_.formula_fault) {
    if (const auto fault = context_.formula_fault(value.text, entry.variables)) {
      const std::string known = entry.variables.empty() ? "" : join(entry.variables) + ", ";
      report(value, path, *fault, "an expression of " + known + "pi");
      return false;
    }
  }
  result.text = value.text;
  return true;
}

bool SchemaReader::formulas(const Entry& entry, const Value& value, const std::string& path,
                            Formula* result) {
  if (!has_length(entry, value, path, "numbers or expressions")) return false;
  bool good = true;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    good = formula(entry, value.items[i], path + "[" + std::to_string(i) + "]", result[i]) && good;
  }
  return good;
}

bool SchemaReader::points(const Entry& entry, const Value& value, const std::string& path,
                          std::vector<std::array<double, 2>>& result) {
  const bool line = entry.length == 2;  // the ends of a line; else the corners of an outline
  const std::size_t count = value.is(Value::Kind::array) ? value.items.size() : 0;
  if (line ? count != 2 : count < 3) {
    report(value, path, line ? "must be two points" : "must be an array of at least three points",
           line ? "[[x, y], [x, y]]" : "[[x, y], [x, y], [x, y]]");
    return false;
  }
  bool good = true;
  std::vector<std::array<double, 2>> read;
  Entry pair = entry;
  pair.length = 2;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    double point[3] = {0, 0, 0};
    good = vector(pair, value.items[i], path + "[" + std::to_string(i) + "]", point) && good;
    read.push_back({point[0], point[1]});
  }
  if (good) result = std::move(read);
  return good;
}

bool SchemaReader::matrix(const Entry& entry, const Value& value, const std::string& path,
                          std::array<double, 9>& result) {
  if (!value.is(Value::Kind::array) || value.items.size() != 3) {
    report(value, path, "must be an array of three rows",
           "[[11, 12, 13], [21, 22, 23], [31, 32, 33]]");
    return false;
  }
  Entry row = entry;
  row.length = 3;
  bool good = true;
  std::array<double, 9> read{};
  for (std::size_t i = 0; i < 3; ++i) {
    good = vector(row, value.items[i], path + "[" + std::to_string(i) + "]", &read[3 * i]) && good;
  }
  if (good) result = read;
  return good;
}

}  // namespace scree
