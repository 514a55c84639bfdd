// SPDX-License-Identifier: Apache-2.0
// scree post profile: fields along a line, averaged in bins.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/run/quantity.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct ProfileOptions {
  std::string run, width;
  std::vector<std::string> fields, from, to;
  int bins = 0;
  TimeOptions time;
  OutputOptions output;
};

/// The line, and how far around it particles count.
struct Line {
  std::array<double, 3> from{}, direction{};
  double length = 0;
  std::optional<double> reach;  ///< m, half the width; none: everything counts
  int bins = 1;
  bool upright = false;
};

/// Volume-weighted statistics of a bin.
struct Bin {
  double weight = 0, sum = 0, square = 0;
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  std::size_t count = 0;

  void add(double value, double volume) {
    weight += volume;
    sum += volume * value;
    square += volume * value * value;
    low = std::min(low, value);
    high = std::max(high, value);
    ++count;
  }
  double mean() const { return sum / weight; }
  double deviation() const { return std::sqrt(std::max(0.0, square / weight - mean() * mean())); }
};

/// Without --from and --to: through all particles of the frame, from the lowest to the highest.
Line default_line(const Run& run, const WeightedFrame& frame) {
  Line line;
  const auto axis = static_cast<std::size_t>(run.up().axis);
  std::array<double, 3> low{}, high{};
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = std::numeric_limits<double>::max();
    high[a] = std::numeric_limits<double>::lowest();
    for (std::size_t p = 0; p < frame.count(); ++p) {
      low[a] = std::min(low[a], frame.place(p)[a]);
      high[a] = std::max(high[a], frame.place(p)[a]);
    }
    line.from[a] = 0.5 * (low[a] + high[a]);
  }
  // Whole cells of the grid, so that bins hold as many layers of particles each.
  const double h = run.cell_size(), base = run.lower()[axis];
  const double start = base + h * std::floor((low[axis] - base) / h + 1e-9);
  const double end = base + h * std::ceil((high[axis] - base) / h - 1e-9);
  line.length = std::max(h, end - start);
  line.from[axis] = run.up().sign > 0 ? start : end;
  line.direction[axis] = run.up().sign;
  line.upright = true;
  return line;
}

Line choose_line(const ProfileOptions& options, const Run& run, const WeightedFrame& frame) {
  if (options.from.empty() != options.to.empty()) {
    throw UserError("--from and --to belong together");
  }
  Line line;
  if (options.from.empty()) {
    line = default_line(run, frame);
  } else {
    line.from = parse_point("--from", options.from, run.dimension());
    const auto to = parse_point("--to", options.to, run.dimension());
    for (std::size_t a = 0; a < 3; ++a) line.length += std::pow(to[a] - line.from[a], 2);
    line.length = std::sqrt(line.length);
    if (!(line.length > 0)) throw UserError("--from and --to are the same point");
    for (std::size_t a = 0; a < 3; ++a) line.direction[a] = (to[a] - line.from[a]) / line.length;
    line.reach = run.cell_size();
    line.upright = std::abs(line.direction[static_cast<std::size_t>(run.up().axis)]) > 0.9;
  }
  if (!options.width.empty()) {
    const double width = parse_value("--width", options.width, Unit::length);
    if (!(width > 0)) throw UserError("--width must be above 0");
    line.reach = 0.5 * width;
  }
  line.bins = options.bins > 0
                  ? options.bins
                  : std::max(1, static_cast<int>(std::ceil(line.length / run.cell_size() - 1e-9)));
  return line;
}

/// The bin of a point, or nothing.
std::optional<std::size_t> bin_of(const Line& line, const double* x) {
  double along = 0, square = 0;
  for (std::size_t a = 0; a < 3; ++a) along += (x[a] - line.from[a]) * line.direction[a];
  if (along < 0 || along > line.length) return std::nullopt;
  for (std::size_t a = 0; a < 3; ++a) {
    square += std::pow(x[a] - line.from[a] - along * line.direction[a], 2);
  }
  if (line.reach && square > *line.reach * *line.reach) return std::nullopt;
  const double share = along / line.length * line.bins;
  return static_cast<std::size_t>(std::min(line.bins - 1, static_cast<int>(share)));
}

void add_rows(Report& report, const Line& line, const WeightedFrame& frame,
              const std::vector<ParticleQuantity>& wanted) {
  std::vector<std::vector<Bin>> bins(wanted.size(), std::vector<Bin>(std::size_t(line.bins)));
  for (std::size_t q = 0; q < wanted.size(); ++q) {
    const std::vector<double> values = values_of(wanted[q], frame.particles);
    for (std::size_t p = 0; p < frame.count(); ++p) {
      if (!std::isfinite(values[p])) continue;
      if (const auto bin = bin_of(line, frame.place(p)))
        bins[q][*bin].add(values[p], frame.volume[p]);
    }
  }
  for (std::size_t b = 0; b < std::size_t(line.bins); ++b) {
    const double along = (static_cast<double>(b) + 0.5) * line.length / line.bins;
    std::vector<double> row{frame.particles.time, along};
    for (std::size_t a = 0; a < 3; ++a) row.push_back(line.from[a] + along * line.direction[a]);
    row.push_back(static_cast<double>(bins[0][b].count));
    for (const auto& of_quantity : bins) {
      const Bin& bin = of_quantity[b];
      const bool any = bin.count > 0;
      row.insert(row.end(), {any ? bin.mean() : nan, any ? bin.deviation() : nan,
                             any ? bin.low : nan, any ? bin.high : nan});
    }
    report.add(row);
  }
}

/// A chart a quantity; a curve a frame. Upright lines have their height upwards.
std::vector<Chart> charts_of(const Report& report, const Line& line, const Run& run,
                             const std::vector<ParticleQuantity>& wanted, std::size_t frames) {
  std::vector<Chart> charts;
  const auto axis = static_cast<std::size_t>(run.up().axis);
  const std::vector<double> times = report.numbers(0);
  const std::vector<double> where = report.numbers(line.upright ? 2 + axis : 1);
  const std::string place =
      line.upright ? fmt::format("{} (m)", "xyz"[axis]) : "Distance along the line (m)";
  for (std::size_t q = 0; q < wanted.size(); ++q) {
    Chart chart;
    const std::string label = axis_label(wanted[q].name, wanted[q].unit);
    chart.x_label = line.upright ? label : place;
    chart.y_label = line.upright ? place : label;
    const std::vector<double> values = report.numbers(6 + 4 * q);
    for (std::size_t f = 0; f < frames; ++f) {
      Curve curve;
      const std::size_t first = f * std::size_t(line.bins);
      for (std::size_t i = first; i < first + std::size_t(line.bins); ++i) {
        if (!std::isfinite(values[i])) continue;
        curve.x.push_back(line.upright ? values[i] : where[i]);
        curve.y.push_back(line.upright ? where[i] : values[i]);
      }
      curve.colour = curve_colour(f);
      if (frames > 1 && frames <= 8) curve.name = fmt::format("{:.4g} s", times[first]);
      if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
    }
    if (!chart.curves.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

int run_profile(const ProfileOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  const auto wanted = options.fields.empty()
                          ? default_quantities(run.fields(), run.dimension())
                          : quantities(options.fields, run.fields(), run.dimension());
  const std::vector<std::size_t> frames = chosen_frames(run.frames(), options.time);
  Report report;
  report.command = "profile";
  report.run = options.run;
  report.columns = {{"time", "s"}, {"distance", "m"}, {"x", "m"},
                    {"y", "m"},    {"z", "m"},        {"particles", ""}};
  for (const ParticleQuantity& quantity : wanted) {
    for (const char* part : {"", "_deviation", "_min", "_max"}) {
      report.columns.push_back({quantity.name + part, quantity.unit});
    }
  }
  Line line;
  FrameProgress progress("frame", frames.size(), options.output.quiet);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const WeightedFrame frame = read_weighted(run, frames[i], needed_fields(wanted));
    // One line for all frames, that of the first: the rows of a place can be compared.
    if (i == 0) line = choose_line(options, run, frame);
    add_rows(report, line, frame, wanted);
    progress.done(i + 1);
  }
  double used = 0;
  for (const double count : report.numbers(5)) used += count;
  if (used == 0) {
    throw UserError("no particle lies near the line; widen it with --width, or move it");
  }
  report.facts = {{"length", line.length, "m"},
                  {"bins", double(line.bins), ""},
                  {"frames", double(frames.size()), ""}};
  const std::string when =
      frames.size() == 1 ? time_text(std::get<double>(report.rows[0][0])) : "several times";
  const auto charts = charts_of(report, line, run, wanted, frames.size());
  deliver(report, charts, run.title(),
          fmt::format("Profile over {:.4g} m, {} bins, {}", line.length, line.bins, when),
          options.output);
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<ProfileOptions>();
  ProfileOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.texts(
      "--field,--fields", options.fields, "F,F,...",
      "Fields or components: pressure, stress.yy, velocity.magnitude, stress.p, ... (default: "
      "speed and mean pressure)");
  set.texts("--from", options.from, "X Y [Z]", "Start of the line (default: the lowest particles)",
            2, 3);
  set.texts("--to", options.to, "X Y [Z]", "End of the line (default: the highest particles)", 2,
            3);
  set.text("--width", options.width, "W",
           "Of the band or cylinder around the line whose particles count (default: two cells; "
           "everything without --from)");
  set.whole_number("--bins", options.bins, 1, 1000000, "N",
                   "Along the line (default: one a cell size)");
  add_time_options(set, options.time, true);
  add_output_options(set, options.output);
  return [shared](const PostWords&) { return run_profile(*shared); };
}

}  // namespace

PostCommand post_profile() {
  return {"profile", "Fields along a line, averaged in bins", false, &declare};
}

}  // namespace scree
