// SPDX-License-Identifier: Apache-2.0
#include "postproc/report/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double value = std::get<double>(cell);
  // Whole numbers (counts) without a point.
  if (std::isfinite(value) && value == std::rint(value) && std::abs(value) < 1e15) {
    return static_cast<std::int64_t>(value);
  }
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string csv_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) {
    if (text->find_first_of(",\"\n") == std::string::npos) return *text;
    std::string quoted = "\"";
    for (const char c : *text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
  }
  const double value = std::get<double>(cell);
  return std::isfinite(value) ? fmt::format("{}", value + 0.0) : "";
}

}  // namespace

std::vector<double> Report::numbers(std::size_t column) const {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const auto& row : rows) result.push_back(std::get<double>(row[column]));
  return result;
}

std::string to_csv(const Report& report) {
  std::string text;
  for (const TableColumn& column : report.columns) {
    text += (text.empty() ? "" : ",") + column.name;
  }
  text += "\n";
  for (const auto& row : report.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) text += (c > 0 ? "," : "") + csv_of(row[c]);
    text += "\n";
  }
  return text;
}

std::string to_json(const Report& report) {
  Json json;
  json["command"] = report.command;
  json["run"] = report.run;
  Json facts = Json::object(), units = Json::object(), columns = Json::array();
  for (const Fact& fact : report.facts) {
    facts[fact.name] = json_of(fact.value);
    if (!fact.unit.empty()) units[fact.name] = fact.unit;
  }
  for (const TableColumn& column : report.columns) {
    columns.push_back(column.name);
    if (!column.unit.empty()) units[column.name] = column.unit;
  }
  json["facts"] = facts;
  json["units"] = units;
  json["columns"] = columns;
  Json rows = Json::array();
  for (const auto& row : report.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) cells.push_back(json_of(cell));
    rows.push_back(cells);
  }
  json["rows"] = rows;
  json["remarks"] = report.remarks;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const Report& report) {
  std::string text;
  for (const Fact& fact : report.facts) {
    std::string name = fact.name;
    for (char& c : name) c = c == '_' ? ' ' : c;
    const auto* words = std::get_if<std::string>(&fact.value);
    text += fmt::format(
        "{}: {}{}\n", name,
        words != nullptr ? *words : fmt::format("{:.6g}", std::get<double>(fact.value) + 0.0),
        fact.unit.empty() ? "" : " " + fact.unit);
  }
  for (const std::string& remark : report.remarks) text += remark + "\n";
  return text;
}

}  // namespace scree
