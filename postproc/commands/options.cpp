// SPDX-License-Identifier: Apache-2.0
#include "postproc/commands/options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "solver/base/error.hpp"
#include "solver/base/units.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void add_output_options(OptionSet& set, OutputOptions& options) {
  set.text("-o,--output", options.table, "FILE.csv|FILE.json",
           "Write the table there (default: print it)");
  set.text("--plot", options.plot, "FILE.png|FILE.svg", "Draw it");
  set.flag("--json", options.json, "The table as JSON, with the facts");
  set.flag("--quiet", options.quiet, "Print the table and errors only");
}

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_target(const std::string& path, const Run& run) {
  std::error_code ignored;
  const fs::path target(path);
  if (fs::is_directory(target, ignored)) throw UserError(path + " is a folder; name a file");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw UserError("there is no folder " + folder.string() + " to write " +
                    target.filename().string() + " into");
  }
  const std::string name = target.filename().string();
  const bool in_run = fs::equivalent(folder, run.folder(), ignored);
  const fs::path frames = run.folder() / "frames";
  const bool in_frames = fs::exists(frames, ignored) && fs::equivalent(folder, frames, ignored);
  const auto own = {"resolved.toml", "run.json",      "history.csv",  "particles.pvd",
                    "grid.pvd",      "checkpoint.h5", "particles.h5", "particles.xdmf"};
  if (in_frames || (in_run && std::find(own.begin(), own.end(), name) != own.end())) {
    throw UserError(path + " is a file of the run itself; name another one");
  }
}

void check_targets(const OutputOptions& options, const Run& run) {
  if (!options.table.empty()) {
    const std::string kind = extension_of(options.table);
    if (kind != "csv" && kind != "json") {
      throw UserError("-o " + options.table + ": the name must end in .csv or .json");
    }
    check_target(options.table, run);
  }
  if (!options.plot.empty()) {
    const std::string kind = extension_of(options.plot);
    if (kind != "png" && kind != "svg") {
      throw UserError("--plot " + options.plot + ": the name must end in .png or .svg");
    }
    check_target(options.plot, run);
  }
}

void print_facts(const Report& report, const OutputOptions& options) {
  if (options.quiet) return;
  std::FILE* const out = options.table.empty() ? stderr : stdout;
  if (out == stderr && options.json) return;  // the facts are in the object
  fmt::print(out, "{}", to_text(report));
}

void deliver(const Report& report, const std::vector<Chart>& charts, const std::string& title,
             const std::string& subtitle, const OutputOptions& options) {
  const bool json = options.json || extension_of(options.table) == "json";
  const std::string text = json ? to_json(report) : to_csv(report);
  if (options.table.empty()) {
    fmt::print("{}", text);
  } else {
    replace_file(options.table, text);
  }
  if (!options.plot.empty()) {
    write_page(options.plot, "scree post " + report.command, title, subtitle, charts);
  }
  print_facts(report, options);
}

void add_time_options(OptionSet& set, TimeOptions& options, bool several) {
  set.text("--time", options.time, "T", "Nearest frame (default: the last)");
  if (!several) return;
  set.texts("--times", options.times, "T,T,...", "Frames nearest to these times");
  set.flag("--all", options.all, "All frames");
}

double parse_value(const std::string& option, const std::string& text, Unit unit) {
  const auto quantity = parse_quantity(text);
  const bool good = quantity && quantity->unknown_unit.empty() && std::isfinite(quantity->value) &&
                    (!quantity->has_unit || quantity->dimension == dimension_of(unit));
  if (!good) {
    throw UserError(fmt::format(
        "{} {}: must be a {} in {}{}", option, text, unit_quantity(unit), unit_symbol(unit),
        unit == Unit::none ? "a plain number" : " or with a unit: " + unit_examples(unit)));
  }
  return quantity->value;
}

std::array<double, 3> parse_point(const std::string& option, const std::vector<std::string>& words,
                                  int dimension) {
  if (words.size() != static_cast<std::size_t>(dimension) && words.size() != 3) {
    throw UserError(fmt::format("{}: needs {} lengths, not {}", option, dimension, words.size()));
  }
  std::array<double, 3> point{};
  for (std::size_t a = 0; a < words.size(); ++a) {
    point[a] = parse_value(option, words[a], Unit::length);
  }
  if (dimension == 2 && point[2] != 0) {
    throw UserError(option + ": z must be 0 in a run of two dimensions");
  }
  return point;
}

Direction parse_direction(const std::string& option, const std::string& text, int dimension) {
  const bool negative = !text.empty() && text[0] == '-';
  const std::string letter =
      !text.empty() && (text[0] == '-' || text[0] == '+') ? text.substr(1) : text;
  const std::size_t axis = std::string("xyz").find(letter);
  if (letter.size() != 1 || axis == std::string::npos || static_cast<int>(axis) >= dimension) {
    throw UserError(fmt::format("{} {}: must be {} or one of these with a minus", option, text,
                                dimension == 2 ? "x, y" : "x, y, z"));
  }
  return {static_cast<int>(axis), negative ? -1 : 1};
}

std::vector<std::size_t> chosen_frames(const FrameSource& frames, const TimeOptions& options) {
  const std::vector<double>& times = frames.times();
  std::vector<std::size_t> chosen;
  if (int(options.all) + int(!options.time.empty()) + int(!options.times.empty()) > 1) {
    throw UserError("--time, --times and --all exclude each other");
  }
  if (options.all) {
    for (std::size_t i = 0; i < times.size(); ++i) chosen.push_back(i);
    return chosen;
  }
  std::vector<std::string> words = options.times;
  if (!options.time.empty()) words = {options.time};
  if (words.empty()) return {times.size() - 1};
  const double distance =
      times.size() > 1 ? (times.back() - times.front()) / static_cast<double>(times.size() - 1) : 0;
  for (const std::string& word : words) {
    const double time = parse_value(options.time.empty() ? "--times" : "--time", word, Unit::time);
    const double room = 0.5 * distance + 1e-9 * std::abs(times.back());
    if (time < times.front() - room || time > times.back() + room) {
      throw UserError(
          fmt::format("there is no frame near t = {:g} s; the frames go from {:g} to "
                      "{:g} s",
                      time, times.front(), times.back()));
    }
    const std::size_t frame = nearest_frame(frames, time);
    if (chosen.empty() || chosen.back() != frame) chosen.push_back(frame);
  }
  return chosen;
}

FrameProgress::FrameProgress(std::string what, std::size_t total, bool quiet)
    : what_(std::move(what)),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      started_(now()),
      last_(started_) {}

void FrameProgress::done(std::size_t count) {
  const double time = now();
  // Short work stays silent.
  if (quiet_ || total_ < 2 || time - started_ < 1 || time - last_ < (terminal_ ? 0.1 : 10)) return;
  last_ = time;
  const double left = (time - started_) / static_cast<double>(count) *
                      static_cast<double>(total_ - std::min(count, total_));
  fmt::print(stderr, "{}{} {} of {}, {:.0f} s left{}", terminal_ ? "\r\033[K" : "", what_, count,
             total_, left, terminal_ ? "" : "\n");
  std::fflush(stderr);
  shown_ = terminal_;
}

FrameProgress::~FrameProgress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

std::string time_text(double time) { return fmt::format("t = {:.6g} s", time); }

std::string axis_label(const std::string& name, const std::string& unit) {
  std::string label = name;
  for (char& c : label) c = c == '_' ? ' ' : c;
  if (!label.empty())
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return unit.empty() ? label : label + " (" + unit + ")";
}

Colour curve_colour(std::size_t index) {
  static constexpr std::array<Colour, 8> colours = {{{0.0, 0.33, 0.65},
                                                     {0.84, 0.37, 0.0},
                                                     {0.0, 0.55, 0.37},
                                                     {0.75, 0.24, 0.52},
                                                     {0.45, 0.45, 0.45},
                                                     {0.90, 0.62, 0.0},
                                                     {0.34, 0.71, 0.91},
                                                     {0.55, 0.34, 0.16}}};
  return colours[index % colours.size()];
}

}  // namespace scree
