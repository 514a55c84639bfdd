// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/syntax_error.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace scree {
namespace {

/// One drawn place: " 12 | text" and below it "    |   ^--- comment".
struct Drawing {
  int line = 0;
  int column = 0;
  std::string text, comment;
};

struct Report {
  std::string headline;
  std::vector<Drawing> places;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

Report parse(const std::string& message) {
  Report report;
  std::istringstream stream(message);
  std::getline(stream, report.headline);
  std::size_t prefix = 0;
  for (std::string line; std::getline(stream, line);) {
    const auto bar = line.find(" | ");
    if (bar == std::string::npos) continue;
    const std::string number = trimmed(line.substr(0, bar));
    if (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos) {
      prefix = bar + 3;
      report.places.push_back({std::atoi(number.c_str()), 1, line.substr(prefix), ""});
    } else if (number.empty() && !report.places.empty()) {
      const auto mark = line.find_first_of("^~", prefix);
      if (mark == std::string::npos) continue;
      Drawing& place = report.places.back();
      place.column = static_cast<int>(mark - prefix) + 1;
      const auto comment = line.find_first_not_of("^~-", mark);
      if (comment != std::string::npos) place.comment = trimmed(line.substr(comment));
    }
  }
  return report;
}

/// Without "[error]" and the parser's function name.
std::string sentence(std::string headline) {
  for (const std::string& prefix : {std::string("[error] "), std::string("toml::")}) {
    if (headline.rfind(prefix, 0) == 0) headline.erase(0, prefix.size());
  }
  const auto colon = headline.find(": ");
  const bool function = colon != std::string::npos && headline.rfind("parse_", 0) == 0;
  if (function) headline.erase(0, colon + 2);
  if (headline.rfind("insert_value: ", 0) == 0) headline.erase(0, 14);
  while (!headline.empty() && headline.back() == '.') headline.pop_back();
  return headline;
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// "value ("a") already exists" -> a
std::string quoted_name(const std::string& text) {
  const auto open = text.find("(\""), close = text.find("\")");
  if (open == std::string::npos || close == std::string::npos) return {};
  return text.substr(open + 2, close - open - 2);
}

std::string repair_for(const std::string& message, const Drawing& place) {
  const std::string rest = trimmed(
      place.text.substr(std::min(place.text.size(), static_cast<std::size_t>(place.column - 1))));
  if (contains(place.comment, "expected newline")) {
    return "one key = value a line; a number with a unit goes in quotes: \"5 mm\"";
  }
  if (contains(message, "invalid key") && rest.empty() && contains(place.text, "{")) {
    return "a table in braces must stand on one line";
  }
  if (contains(message, "invalid key") && rest.rfind("[", 0) == 0) {
    return "write a table's header as [name]";
  }
  if (contains(message, "array separator")) {
    return "close the array that begins here with ], and separate its entries by commas";
  }
  if (contains(message, "unknown value")) {
    return "texts go in quotes; booleans are true and false";
  }
  if (contains(message, "not a valid string")) return "close the quotes on the same line";
  return {};
}

}  // namespace

Problem syntax_problem(const std::string& message,
                       const std::shared_ptr<const std::string>& source) {
  const Report report = parse(message);
  Problem problem;
  problem.where.source = source;
  const std::string headline = sentence(report.headline);
  if (report.places.empty()) {
    problem.message = "is no TOML: " + headline;
    return problem;
  }
  // Two places mean "already exists here" and "defined twice": the second is the mistake. An array
  // that is not closed is drawn where it starts and where the document ends: take the start.
  const bool twice = contains(headline, "already exists");
  const Drawing& place = twice ? report.places.back() : report.places.front();
  problem.where.line = place.line;
  problem.where.column = place.column;
  if (twice) {
    problem.message =
        "is defined twice; first in line " + std::to_string(report.places.front().line);
    problem.key = quoted_name(headline);
    problem.repair = "remove one of them";
    return problem;
  }
  problem.message = "is no TOML: " + headline;
  const Drawing& last = report.places.back();
  std::string comment = last.comment;
  while (!comment.empty() && comment.back() == '.') comment.pop_back();
  if (!comment.empty() && comment != "here") problem.message += " (" + comment + ")";
  problem.repair = repair_for(headline, place);
  return problem;
}

}  // namespace scree
