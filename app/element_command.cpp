// SPDX-License-Identifier: Apache-2.0
#include "app/element_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "app/element_plot.hpp"
#include "solver/base/error.hpp"
#include "solver/element/element_table.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

/// The first bytes of a file, or nothing.
std::string beginning(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(4096, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

/// Refuses, without writing, to write where another file stands or where nothing can be written.
/// A former result, which has `mark` near its beginning, and an empty file may be replaced.
void check_target(const fs::path& path, const std::string& mark, bool overwrite) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw UserError(path.string() + " is a folder; name a file");
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw UserError("there is no folder " + folder.string() + " to write " +
                    path.filename().string() + " into");
  }
  if (overwrite || !fs::exists(path, ignored)) return;
  const std::string text = beginning(path);
  if (text.empty() || text.find(mark) != std::string::npos) return;
  throw UserError(path.string() +
                  " exists and was not written by scree element; name another file, or add "
                  "--overwrite");
}

void print_summary(const ElementDeck& deck, const ElementResult& result, const std::string& table) {
  const ElementRow& last = result.rows.back();
  fmt::print("{}: {} of {}, {} steps -> {}\n", deck.title.empty() ? deck.name : deck.title,
             lab_test_name(deck.driven.type), deck.materials.front().model, last.step, table);
  fmt::print(
      "at the end: p {:.6g} Pa, q {:.6g} Pa, sigma {:.6g} {:.6g} {:.6g} Pa, tau_12 {:.6g} "
      "Pa, volumetric strain {:.4g}{}\n",
      0.0 + last.pressure(), last.deviatoric(), 0.0 - last.cauchy.xx, 0.0 - last.cauchy.yy,
      0.0 - last.cauchy.zz, 0.0 + last.cauchy.xy, 0.0 + last.strain.volumetric,
      last.pore_pressure ? fmt::format(", pore pressure {:.6g} Pa", *last.pore_pressure) : "");
}

}  // namespace

int element_command(const ElementOptions& options) {
  Problems problems;
  const ElementDeck deck = read_element_deck(options.deck, options.overrides, problems);
  if (!problems.empty()) {
    fmt::print(stderr, "{}", problems.text());
    return 2;
  }
  const std::string table = options.output.empty() ? deck.name + ".csv" : options.output;
  check_target(table, element_columns, options.overwrite);
  if (options.plot == table) {
    throw UserError("-o and --plot name the same file, " + table);
  }
  if (!options.plot.empty()) check_target(options.plot, plot_mark, options.overwrite);
  const ElementResult result = drive_element(deck);
  replace_file(table, element_csv(result));
  if (!options.plot.empty()) plot_element(deck, result, options.plot);
  if (!options.quiet) print_summary(deck, result, table);
  return 0;
}

}  // namespace scree
