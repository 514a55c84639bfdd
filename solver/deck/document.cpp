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

#include "solver/deck/nesting.hpp"
#include "solver/deck/quiet_floats.hpp"
#include "solver/deck/syntax_error.hpp"
#include "solver/deck/text_encoding.hpp"

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
    value.text = source_text(toml);
    std::string text = value.text;
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

}  // namespace

Problem source_problem(const std::shared_ptr<const std::string>& source, std::string message,
                       std::string repair) {
  Problem problem;
  problem.where.source = source;
  problem.message = std::move(message);
  problem.repair = std::move(repair);
  return problem;
}

std::optional<Value> parse_document(const std::string& text, const std::string& source,
                                    Problems& problems) {
  const auto name = std::make_shared<const std::string>(source);
  if (auto problem = encoding_problem(text, name)) {
    problems.add(std::move(*problem));
    return std::nullopt;
  }
  if (auto problem = nesting_problem(text, name)) {
    problems.add(std::move(*problem));
    return std::nullopt;
  }
  std::istringstream stream(text);
  const QuietFloats quiet;
  try {
    const auto toml = toml::parse<toml::discard_comments, std::map, std::vector>(stream, source);
    return Converter(split_lines(text), name).convert(toml);
  } catch (const toml::exception& error) {
    problems.add(syntax_problem(error.what(), name));
  } catch (const std::exception& error) {
    problems.add(source_problem(name, std::string("is no TOML: ") + error.what()));
  }
  return std::nullopt;
}

std::optional<Value> read_document(const std::string& path, Problems& problems) {
  const auto name = std::make_shared<const std::string>(path);
  if (const std::string fault = file_fault(path); !fault.empty()) {
    problems.add(source_problem(name, fault));
    return std::nullopt;
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    const char* const hint =
        "begin with inputs/tutorial/sand_column_2d.toml, or see scree describe";
    problems.add(source_problem(name, "the deck is empty", hint));
    return std::nullopt;
  }
  return parse_document(text, path, problems);
}

}  // namespace scree
