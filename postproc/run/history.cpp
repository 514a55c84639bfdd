// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <fstream>
#include <sstream>

#include "postproc/run/run.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The numbers of a row; empty if one of the cells is none.
std::vector<double> numbers(const std::vector<std::string>& cells) {
  std::vector<double> result;
  for (const std::string& cell : cells) {
    double value = 0;
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || stop != end) return {};
    result.push_back(value);
  }
  return result;
}

}  // namespace

History read_history(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "history.csv";
  std::ifstream in(path, std::ios::binary);
  std::string line;
  if (!in || !std::getline(in, line)) throw UserError(path.string() + " cannot be read");
  History history;
  history.names = split(line);
  for (const std::string& name : history.names) history.columns[name] = {};
  for (std::int64_t row = 2; std::getline(in, line); ++row) {
    // A last line without an end is being written.
    if (in.eof()) break;
    const std::vector<double> values = numbers(split(line));
    if (values.size() != history.names.size()) {
      throw UserError(path.string() + ":" + std::to_string(row) + ": not a row of " +
                      std::to_string(history.names.size()) + " numbers");
    }
    for (std::size_t c = 0; c < values.size(); ++c) {
      history.columns[history.names[c]].push_back(values[c]);
    }
  }
  if (history.rows() == 0) throw UserError(path.string() + " has no rows yet");
  return history;
}

}  // namespace scree
