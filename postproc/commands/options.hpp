// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "postproc/commands/option_set.hpp"
#include "postproc/plot/chart.hpp"
#include "postproc/report/table.hpp"
#include "postproc/run/run.hpp"
#include "solver/base/units.hpp"

/// Options that the commands share, and what they do.
namespace scree {

/// Where a command's table and plot go.
struct OutputOptions {
  std::string table, plot;
  bool json = false, quiet = false;
};

/// Adds -o, --plot, --json and --quiet.
void add_output_options(OptionSet& set, OutputOptions& options);

/// Checks, before any work, that these files can be written: refuses folders that are not there and
/// files of the run itself. Throws UserError.
void check_targets(const OutputOptions& options, const Run& run);
void check_target(const std::string& path, const Run& run);

/// The extension of a path without its point, in lower case.
std::string extension_of(const std::string& path);

/// Writes or prints the report and draws the plot (PNG or SVG by its name). The table goes to
/// standard output, or with -o into a file; facts and remarks go where the table does not.
void deliver(const Report& report, const std::vector<Chart>& charts, const std::string& title,
             const std::string& subtitle, const OutputOptions& options);

/// Prints facts and remarks beside a table that takes standard output.
void print_facts(const Report& report, const OutputOptions& options);

/// Which frames a command looks at.
struct TimeOptions {
  std::string time;                ///< of one frame; "" the last
  std::vector<std::string> times;  ///< of several
  bool all = false;
};

/// Adds --time; with `several` also --times and --all.
void add_time_options(OptionSet& set, TimeOptions& options, bool several);

/// The frames that were asked for: the last one without an option. Throws UserError for a time that
/// is none, or beyond the frames by more than half their distance.
std::vector<std::size_t> chosen_frames(const FrameSource& frames, const TimeOptions& options);

/// A length, time, ... in SI: a number, or one with a unit. Throws UserError.
double parse_value(const std::string& option, const std::string& text, Unit unit);

/// A point or vector of `dimension` lengths (three are allowed in 2D, too). Throws UserError.
std::array<double, 3> parse_point(const std::string& option, const std::vector<std::string>& words,
                                  int dimension);

/// "x", "-y", ...; Throws UserError.
Direction parse_direction(const std::string& option, const std::string& text, int dimension);

/// Progress over frames on a terminal's standard error; a line every ten seconds elsewhere.
class FrameProgress {
 public:
  FrameProgress(std::string what, std::size_t total, bool quiet);
  void done(std::size_t count);
  ~FrameProgress();
  FrameProgress(const FrameProgress&) = delete;
  FrameProgress& operator=(const FrameProgress&) = delete;

 private:
  std::string what_;
  std::size_t total_;
  bool quiet_, terminal_, shown_ = false;
  double started_, last_;
};

/// "t = 0.5 s"
std::string time_text(double time);

/// "Pressure (Pa)" for a column "pressure" in Pa.
std::string axis_label(const std::string& name, const std::string& unit);

/// Colours for several curves, in order; repeats after eight.
Colour curve_colour(std::size_t index);

}  // namespace scree
