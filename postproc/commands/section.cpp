// SPDX-License-Identifier: Apache-2.0
// scree post section: fields on the cells of a plane through the body.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/plot/heat_map.hpp"
#include "postproc/run/quantity.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

struct SectionOptions {
  std::string run, normal, position, thickness, spacing;
  std::vector<std::string> fields, range;
  TimeOptions time;
  OutputOptions output;
};

/// A slab around a plane that is normal to an axis, and square cells in it. In 2D it is the plane
/// of the run.
struct Slab {
  std::size_t normal = 2, across = 0, upward = 1;
  double place = 0;                ///< m, along the normal
  double reach = -1;               ///< m, half the thickness; negative: everything counts
  double spacing = 1;              ///< m
  std::array<double, 3> origin{};  ///< m, that cells are counted from
};

/// Sums over the particles of a cell.
struct Cell {
  double volume = 0;
  std::size_t count = 0;
  std::vector<double> weight, sum;  ///< a quantity
};

using Cells = std::map<std::pair<long, long>, Cell>;  ///< by row (upward), column

/// Axes in the plane: the one along gravity upwards, if it lies in it.
void choose_axes(const SectionOptions& options, const Run& run, Slab& slab) {
  const auto up = static_cast<std::size_t>(run.up().axis);
  if (run.dimension() == 2) {
    if (!options.normal.empty() || !options.position.empty() || !options.thickness.empty()) {
      throw UserError(
          "a run in two dimensions is its own section: --normal, --position and "
          "--thickness need three");
    }
    return;
  }
  slab.normal = up == 1 ? 2 : 1;
  if (!options.normal.empty()) {
    slab.normal = static_cast<std::size_t>(parse_direction("--normal", options.normal, 3).axis);
  }
  slab.upward = slab.normal == up ? (up == 2 ? 1 : 2) : up;
  slab.across = 3 - slab.normal - slab.upward;
}

Slab choose_slab(const SectionOptions& options, const Run& run, const WeightedFrame& frame) {
  Slab slab;
  slab.origin = run.lower();
  slab.spacing = options.spacing.empty() ? run.cell_size()
                                         : parse_value("--spacing", options.spacing, Unit::length);
  if (!(slab.spacing > 0)) throw UserError("--spacing must be above 0");
  choose_axes(options, run, slab);
  if (run.dimension() == 2) return slab;
  slab.reach = 0.5 * (options.thickness.empty()
                          ? 2 * run.cell_size()
                          : parse_value("--thickness", options.thickness, Unit::length));
  if (!(slab.reach > 0)) throw UserError("--thickness must be above 0");
  if (!options.position.empty()) {
    slab.place = parse_value("--position", options.position, Unit::length);
    return slab;
  }
  // Where the body is: the mean of its particles.
  double sum = 0, volume = 0;
  for (std::size_t p = 0; p < frame.count(); ++p) {
    sum += frame.volume[p] * frame.place(p)[slab.normal];
    volume += frame.volume[p];
  }
  slab.place = sum / volume;
  return slab;
}

Cells fill_cells(const Slab& slab, const WeightedFrame& frame,
                 const std::vector<std::vector<double>>& values) {
  Cells cells;
  for (std::size_t p = 0; p < frame.count(); ++p) {
    const double* x = frame.place(p);
    if (slab.reach >= 0 && std::abs(x[slab.normal] - slab.place) > slab.reach) continue;
    const auto index = [&](std::size_t axis) {
      return std::lround(std::floor((x[axis] - slab.origin[axis]) / slab.spacing));
    };
    Cell& cell = cells[{index(slab.upward), index(slab.across)}];
    cell.weight.resize(values.size());
    cell.sum.resize(values.size());
    cell.volume += frame.volume[p];
    ++cell.count;
    for (std::size_t q = 0; q < values.size(); ++q) {
      if (!std::isfinite(values[q][p])) continue;
      cell.weight[q] += frame.volume[p];
      cell.sum[q] += frame.volume[p] * values[q][p];
    }
  }
  return cells;
}

HeatMap map_of(const Slab& slab, const Cells& cells, const ParticleQuantity& quantity) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::pair<long, long> low = cells.begin()->first, high = low;
  for (const auto& [at, cell] : cells) {
    low = {std::min(low.first, at.first), std::min(low.second, at.second)};
    high = {std::max(high.first, at.first), std::max(high.second, at.second)};
  }
  HeatMap map;
  map.columns = static_cast<std::size_t>(high.second - low.second + 1);
  map.rows = static_cast<std::size_t>(high.first - low.first + 1);
  map.values.assign(map.columns * map.rows, nan);
  for (const auto& [at, cell] : cells) {
    if (!(cell.weight[0] > 0)) continue;
    map.values[static_cast<std::size_t>(at.first - low.first) * map.columns +
               static_cast<std::size_t>(at.second - low.second)] = cell.sum[0] / cell.weight[0];
  }
  const auto edge = [&](std::size_t axis, long index) {
    return slab.origin[axis] + slab.spacing * static_cast<double>(index);
  };
  map.x_low = edge(slab.across, low.second);
  map.x_high = edge(slab.across, high.second + 1);
  map.y_low = edge(slab.upward, low.first);
  map.y_high = edge(slab.upward, high.first + 1);
  map.x_label = fmt::format("{} (m)", "xyz"[slab.across]);
  map.y_label = fmt::format("{} (m)", "xyz"[slab.upward]);
  map.value_label = axis_label(quantity.name, quantity.unit);
  return map;
}

void draw(const SectionOptions& options, const Run& run, const Slab& slab, const Cells& cells,
          const ParticleQuantity& quantity, double time) {
  if (options.output.plot.empty()) return;
  HeatMap map = map_of(slab, cells, quantity);
  map.title = run.title();
  map.subtitle = slab.reach < 0 ? fmt::format("Cell means, {}", time_text(time))
                                : fmt::format("Section at {} = {:.4g} m, {}", "xyz"[slab.normal],
                                              slab.place, time_text(time));
  if (!options.range.empty()) {
    map.low = parse_value("--range", options.range[0], Unit::none);
    map.high = parse_value("--range", options.range[1], Unit::none);
    if (!(map.high > map.low))
      throw UserError("--range: the first number must be below the second");
  }
  write_heat_map(options.output.plot, "scree post section", map);
}

/// A row a cell.
void add_rows(Report& report, const Slab& slab, const Cells& cells, std::size_t quantities) {
  for (const auto& [at, cell] : cells) {
    std::array<double, 3> x{};
    x[slab.normal] = slab.place;
    x[slab.across] = slab.origin[slab.across] + slab.spacing * (double(at.second) + 0.5);
    x[slab.upward] = slab.origin[slab.upward] + slab.spacing * (double(at.first) + 0.5);
    std::vector<double> row{x[0], x[1], x[2], double(cell.count), cell.volume};
    for (std::size_t q = 0; q < quantities; ++q) row.push_back(cell.sum[q] / cell.weight[q]);
    report.add(row);
  }
}

int run_section(const SectionOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  const auto wanted = options.fields.empty()
                          ? default_quantities(run.fields(), run.dimension())
                          : quantities(options.fields, run.fields(), run.dimension());
  const std::size_t index = chosen_frames(run.frames(), options.time).front();
  const WeightedFrame frame = read_weighted(run, index, needed_fields(wanted));
  if (frame.count() == 0) throw UserError("the frame holds no particles");
  const Slab slab = choose_slab(options, run, frame);
  std::vector<std::vector<double>> values;
  for (const auto& quantity : wanted) values.push_back(values_of(quantity, frame.particles));
  const Cells cells = fill_cells(slab, frame, values);
  if (cells.empty()) {
    throw UserError(fmt::format("no particle lies within {:g} m of {} = {:g} m", slab.reach,
                                "xyz"[slab.normal], slab.place));
  }
  Report report;
  report.command = "section";
  report.run = options.run;
  report.columns = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"particles", ""}, {"volume", "m^3"}};
  for (const auto& quantity : wanted) report.columns.push_back({quantity.name, quantity.unit});
  add_rows(report, slab, cells, wanted.size());
  report.facts = {{"time", frame.particles.time, "s"},
                  {"cells", double(cells.size()), ""},
                  {"spacing", slab.spacing, "m"}};
  if (slab.reach >= 0) {
    report.facts.push_back({"normal", std::string(1, "xyz"[slab.normal]), ""});
    report.facts.push_back({"position", slab.place, "m"});
    report.facts.push_back({"thickness", 2 * slab.reach, "m"});
  }
  draw(options, run, slab, cells, wanted.front(), frame.particles.time);
  OutputOptions rest = options.output;
  rest.plot.clear();  // drawn
  deliver(report, {}, "", "", rest);
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<SectionOptions>();
  SectionOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.texts("--field,--fields", options.fields, "F,F,...",
            "Fields or components; the plot shows the first (default: speed and mean pressure)");
  set.text("--normal", options.normal, "x|y|z",
           "Of the plane, in three dimensions (default: a horizontal axis)");
  set.text("--position", options.position, "X",
           "Of the plane along its normal (default: through the body's centre)");
  set.text("--thickness", options.thickness, "T",
           "Of the slab whose particles count (default: two cells)");
  set.text("--spacing", options.spacing, "H", "Of the cells (default: the cell size)");
  set.texts("--range", options.range, "LOW HIGH", "Of the plot's colours", 2, 2);
  add_time_options(set, options.time, false);
  add_output_options(set, options.output);
  return [shared](const PostWords&) { return run_section(*shared); };
}

}  // namespace

PostCommand post_section() {
  return {"section", "Fields on the cells of a plane", false, &declare};
}

}  // namespace scree
