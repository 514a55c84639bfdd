// SPDX-License-Identifier: Apache-2.0
#include "app/deck_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

namespace scree {

namespace {

std::string trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The line without its comment; a # inside quotes is no comment.
std::string without_comment(const std::string& line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == '"' && c == '\\') {
      ++i;
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return line.substr(0, i);
    }
  }
  return line;
}

bool open_brackets(const std::string& value) {
  return std::count(value.begin(), value.end(), '[') >
             std::count(value.begin(), value.end(), ']') ||
         std::count(value.begin(), value.end(), '{') > std::count(value.begin(), value.end(), '}');
}

bool allowed(const std::string& key, const std::string& former, const std::string& current) {
  static const std::set<std::string> free = {"title", "output.precision"};
  if (key != "time.end") return free.contains(key);
  return std::strtod(current.c_str(), nullptr) > std::strtod(former.c_str(), nullptr);
}

/// What to do instead of the change, for the brackets of its line.
std::string advice(const std::string& key, const std::string& current) {
  return key == "time.end" ? "; to stop earlier use --until " + current : "";
}

std::string shown(const std::map<std::string, std::string>& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? "not given" : found->second;
}

}  // namespace

std::map<std::string, std::string> deck_values(const std::string& resolved_toml) {
  std::map<std::string, std::string> values;
  std::istringstream in(resolved_toml);
  std::string table;
  for (std::string line; std::getline(in, line);) {
    line = trim(without_comment(line));
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    if (line.front() == '[') {
      table = trim(line.substr(1, line.rfind(']') - 1)) + ".";
    } else if (equals != std::string::npos) {
      std::string value = trim(line.substr(equals + 1));
      for (std::string more; open_brackets(value) && std::getline(in, more);) {
        value += " " + trim(without_comment(more));
      }
      values[table + trim(line.substr(0, equals))] = value;
    }
  }
  return values;
}

std::vector<std::string> forbidden_changes(const std::string& former_toml,
                                           const std::string& current_toml) {
  const auto former = deck_values(former_toml);
  const auto current = deck_values(current_toml);
  std::set<std::string> keys;
  for (const auto& [key, value] : former) keys.insert(key);
  for (const auto& [key, value] : current) keys.insert(key);
  std::vector<std::string> changes;
  for (const std::string& key : keys) {
    const std::string was = shown(former, key);
    const std::string is = shown(current, key);
    if (was == is || allowed(key, was, is)) continue;
    changes.push_back(fmt::format("{} = {} (was {}{})", key, is, was, advice(key, is)));
  }
  return changes;
}

}  // namespace scree
