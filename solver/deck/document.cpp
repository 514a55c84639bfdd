// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/document.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <toml.hpp>

#include "solver/deck/syntax_error.hpp"

namespace scree {
namespace {

using TomlValue = toml::basic_value<toml::discard_comments, std::map, std::vector>;

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Turns toml11's tree into ours: order of the text, positions of keys, numbers that overflow.
class Converter {
 public:
  Converter(std::vector<std::string> lines, std::shared_ptr<const std::string> source)
      : lines_(std::move(lines)), source_(std::move(source)) {}

  Value convert(const TomlValue& toml) const {
    Value value;
    value.position = position(toml);
    value.key_position = value.position;
    switch (toml.type()) {
      case toml::value_t::boolean:
        set(value, toml.as_boolean());
        break;
      case toml::value_t::integer:
      case toml::value_t::floating:
        set_number(value, toml);
        break;
      case toml::value_t::string:
        value.kind = Value::Kind::text;
        value.text = toml.as_string().str;
        break;
      case toml::value_t::array:
        value.kind = Value::Kind::array;
        for (const auto& item : toml.as_array()) value.items.push_back(convert(item));
        break;
      case toml::value_t::table:
        set_table(value, toml);
        break;
      default:
        value.kind = Value::Kind::other;
        value.text = source_text(toml);
    }
    return value;
  }

 private:
  static void set(Value& value, bool boolean) {
    value.kind = Value::Kind::boolean;
    value.boolean = boolean;
  }

  void set_table(Value& value, const TomlValue& toml) const {
    value.kind = Value::Kind::table;
    for (const auto& [key, item] : toml.as_table()) {
      Value& member = value.items.emplace_back(convert(item));
      member.key = key;
      member.key_position = key_position(member);
    }
    std::stable_sort(value.items.begin(), value.items.end(), [](const Value& a, const Value& b) {
      return std::make_pair(a.position.line, a.position.column) <
             std::make_pair(b.position.line, b.position.column);
    });
  }

  /// Numbers are read again from the text: toml11 saturates those that are too large.
  void set_number(Value& value, const TomlValue& toml) const {
    const bool integer = toml.is_integer();
    value.kind = integer ? Value::Kind::integer : Value::Kind::real;
    if (integer) {
      value.integer = toml.as_integer();
    } else {
      value.real = toml.as_floating();
    }
    std::string text = source_text(toml);
    std::erase(text, '_');
    const bool decimal = text.find_first_not_of("+-.0123456789eE") == std::string::npos;
    if (text.empty() || !decimal) return;
    const double number = std::strtod(text.c_str(), nullptr);
    if (integer && std::abs(number) < 9.2e18) return;
    value.kind = Value::Kind::real;
    value.real = number;
  }

  std::string source_text(const TomlValue& toml) const {
    const auto location = toml.location();
    if (location.line() == 0 || location.line() > lines_.size()) return {};
    const std::string& line = lines_[location.line() - 1];
    return location.column() - 1 < line.size()
               ? line.substr(location.column() - 1, location.region())
               : std::string();
  }

  Position position(const TomlValue& toml) const {
    const auto location = toml.location();
    return {source_, static_cast<int>(location.line()), static_cast<int>(location.column())};
  }

  /// Finds the key to the left of "= value"; tables with a header or dotted key keep their place.
  Position key_position(const Value& member) const {
    Position where = member.position;
    if (where.line < 1 || where.line > static_cast<int>(lines_.size())) return where;
    const std::string& line = lines_[static_cast<std::size_t>(where.line - 1)];
    auto i = static_cast<std::size_t>(where.column - 1);
    const auto skip_spaces = [&] {
      while (i > 0 && (line[i - 1] == ' ' || line[i - 1] == '\t')) --i;
    };
    skip_spaces();
    if (i == 0 || line[i - 1] != '=') return where;
    --i;
    skip_spaces();
    const char last = i > 0 ? line[i - 1] : ' ';
    const std::string bare = toml_key(member.key);
    const std::size_t length = last == '"' || last == '\'' ? member.key.size() + 2 : bare.size();
    if (length <= i) where.column = static_cast<int>(i - length) + 1;
    return where;
  }

  std::vector<std::string> lines_;
  std::shared_ptr<const std::string> source_;
};

/// One clear sentence when the file cannot be read, or "".
std::string file_fault(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) return "the deck does not exist";
  if (fs::is_directory(status)) return "the deck is a directory, must be a TOML file";
  std::ifstream file(path);
  if (!file) return "the deck cannot be read: " + std::generic_category().message(errno);
  return {};
}

void merge(Value& table, Value member) {
  if (Value* present = table.find(member.key)) {
    *present = std::move(member);
  } else {
    table.items.push_back(std::move(member));
  }
}

/// Splits at the first "=" that does not stand in quotes.
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

/// The dotted key as a chain of tables with one member each, e.g. a.b -> {a = {b = 0}}.
std::optional<std::vector<std::string>> split_key(const std::string& key,
                                                  const std::string& source) {
  Problems ignored;
  const auto document = parse_document(key + " = 0", source, ignored);
  if (!document) return std::nullopt;
  std::vector<std::string> path;
  for (const Value* value = &*document; !value->items.empty(); value = &value->items.front()) {
    path.push_back(value->items.front().key);
  }
  return path;
}

}  // namespace

std::optional<Value> parse_document(const std::string& text, const std::string& source,
                                    Problems& problems) {
  const auto name = std::make_shared<const std::string>(source);
  std::istringstream stream(text);
  try {
    const auto toml = toml::parse<toml::discard_comments, std::map, std::vector>(stream, source);
    return Converter(split_lines(text), name).convert(toml);
  } catch (const toml::exception& error) {
    problems.add(syntax_problem(error.what(), name));
  } catch (const std::exception& error) {
    Problem problem;
    problem.where.source = name;
    problem.message = std::string("is no TOML: ") + error.what();
    problems.add(problem);
  }
  return std::nullopt;
}

std::optional<Value> read_document(const std::string& path, Problems& problems) {
  const auto name = std::make_shared<const std::string>(path);
  if (const std::string fault = file_fault(path); !fault.empty()) {
    problems.add({{name, 0, 0}, "", "", fault, "", ""});
    return std::nullopt;
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    problems.add({{name, 0, 0},
                  "",
                  "",
                  "the deck is empty",
                  "",
                  "begin with inputs/tutorial/sand_column_2d.toml, or see scree describe"});
    return std::nullopt;
  }
  return parse_document(text, path, problems);
}

void apply_override(Value& document, const std::string& assignment, Problems& problems) {
  const auto source = std::make_shared<const std::string>("--set " + assignment);
  const auto report = [&](const std::string& message, const std::string& repair) {
    problems.add({{source, 0, 0}, "", "", message, "", repair});
  };
  const std::size_t equals = equals_sign(assignment);
  if (equals == std::string::npos || equals == 0) {
    report("is no assignment", "write --set KEY=VALUE, e.g. --set time.end=0.5");
    return;
  }
  const auto path = split_key(assignment.substr(0, equals), *source);
  if (!path) {
    report("has no valid key before the =", "write a dotted key, e.g. time.end");
    return;
  }
  const std::string text = assignment.substr(equals + 1);
  Problems not_toml;
  const auto parsed = parse_document("v = " + text, *source, not_toml);
  Value value;
  if (parsed && parsed->items.size() == 1 && parsed->items.front().key == "v") {
    value = parsed->items.front();
  } else {
    value.kind = Value::Kind::text;
    value.text = text;
  }
  Value* table = &document;
  std::string walked;
  for (std::size_t i = 0; i + 1 < path->size(); ++i) {
    const std::string& key = (*path)[i];
    walked += (walked.empty() ? "" : ".") + key;
    if (!table->find(key)) {
      Value empty;
      empty.key = key;
      relocate(empty, source);
      table->items.push_back(std::move(empty));
    }
    table = table->find(key);
    if (table->is(Value::Kind::table)) continue;
    report(walked + " is " + kind_name(table->kind) + ", not a table",
           "set the whole table, e.g. --set '" + walked + "={ " + path->back() + " = ... }'");
    return;
  }
  value.key = path->back();
  relocate(value, source);
  merge(*table, std::move(value));
}

}  // namespace scree
