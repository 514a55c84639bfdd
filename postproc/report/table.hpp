// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scree {

/// A number or a word of a table. A number that is not finite is an empty cell in CSV and null in
/// JSON.
using Cell = std::variant<double, std::string>;

struct TableColumn {
  std::string name;
  std::string unit;  ///< SI, "" where it has none
};

/// A single result beside the table.
struct Fact {
  std::string name;
  Cell value;
  std::string unit;
};

/// What a command has found.
struct Report {
  std::string command, run;
  std::vector<Fact> facts;
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> remarks;  ///< sentences

  /// A row of numbers.
  void add(const std::vector<double>& values) { rows.emplace_back(values.begin(), values.end()); }
  /// The numbers of a column, for plots.
  std::vector<double> numbers(std::size_t column) const;
};

/// The table with a header line; numbers have the digits that give the same double back.
std::string to_csv(const Report& report);

/// One object: command, run, facts {name: value}, units {name: unit}, columns, rows, remarks.
std::string to_json(const Report& report);

/// Facts and remarks, a line each.
std::string to_text(const Report& report);

}  // namespace scree
