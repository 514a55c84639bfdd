// SPDX-License-Identifier: Apache-2.0
// scree post slip: shear bands, where a strain is above a threshold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/plot/heat_map.hpp"
#include "postproc/run/quantity.hpp"
#include "postproc/slip/bands.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

struct SlipOptions {
  std::string run, field, spacing;
  double threshold = 0;
  int least = 5;
  TimeOptions time;
  OutputOptions output;
};

/// What the picture looks at: along the third axis in 2D, in 3D along the shorter horizontal one.
struct View {
  std::size_t across = 0, upward = 1, along = 2;
};

/// First and last index of the cells on each axis.
struct CellRange {
  std::array<long, 3> low, high;
};

CellRange range_of(const CellField& field) {
  CellRange range{field.cells[0].at, field.cells[0].at};
  for (const CellField::Cell& cell : field.cells) {
    for (std::size_t a = 0; a < 3; ++a) {
      range.low[a] = std::min(range.low[a], cell.at[a]);
      range.high[a] = std::max(range.high[a], cell.at[a]);
    }
  }
  return range;
}

View view_of(const Run& run, const CellRange& range) {
  View view;
  if (run.dimension() == 2) return view;
  view.upward = static_cast<std::size_t>(run.up().axis);
  view.across = view.upward == 0 ? 1 : 0;
  view.along = 3 - view.upward - view.across;
  const auto extent = [&](std::size_t axis) { return range.high[axis] - range.low[axis]; };
  if (extent(view.along) > extent(view.across)) std::swap(view.across, view.along);
  return view;
}

/// Cells above the threshold in their colours, the others at its low end; in 3D the largest strain
/// of those behind each other.
HeatMap map_of(const Run& run, const CellField& field, const CellRange& range, const View& view,
               double threshold) {
  HeatMap map;
  map.low = map.high = threshold;
  const auto width = [&](std::size_t axis) {
    return static_cast<std::size_t>(range.high[axis] - range.low[axis] + 1);
  };
  map.columns = width(view.across);
  map.rows = width(view.upward);
  map.values.assign(map.columns * map.rows, std::numeric_limits<double>::quiet_NaN());
  for (const CellField::Cell& cell : field.cells) {
    const auto column = static_cast<std::size_t>(cell.at[view.across] - range.low[view.across]);
    const auto row = static_cast<std::size_t>(cell.at[view.upward] - range.low[view.upward]);
    double& value = map.values[row * map.columns + column];
    value = std::fmax(std::max(cell.mean, threshold), value);
    map.high = std::max(map.high, cell.mean);
  }
  const auto edge = [&](std::size_t axis, long index) {
    return run.lower()[axis] + field.spacing * static_cast<double>(index);
  };
  map.x_low = edge(view.across, range.low[view.across]);
  map.x_high = edge(view.across, range.high[view.across] + 1);
  map.y_low = edge(view.upward, range.low[view.upward]);
  map.y_high = edge(view.upward, range.high[view.upward] + 1);
  map.x_label = fmt::format("{} (m)", "xyz"[view.across]);
  map.y_label = fmt::format("{} (m)", "xyz"[view.upward]);
  map.value_label = "Strain";
  return map;
}

void draw(const SlipOptions& options, const Run& run, const CellField& field, double threshold,
          const ParticleQuantity& quantity, double time) {
  if (options.output.plot.empty()) return;
  const CellRange range = range_of(field);
  const View view = view_of(run, range);
  HeatMap map = map_of(run, field, range, view, threshold);
  map.title = run.title();
  map.subtitle =
      fmt::format("{} above {:.4g}, {}", axis_label(quantity.name, ""), threshold, time_text(time));
  if (run.dimension() == 3) {
    map.subtitle += fmt::format(", largest along {}", "xyz"[view.along]);
  }
  write_heat_map(options.output.plot, "scree post slip", map);
}

void add_rows(Report& report, const std::vector<ShearBand>& bands, double time) {
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const ShearBand& band = bands[i];
    report.add({time, double(i + 1), double(band.cells), band.volume, band.length, band.thickness,
                band.angle, band.mean, band.largest, band.centre[0], band.centre[1], band.centre[2],
                band.first[0], band.first[1], band.first[2], band.last[0], band.last[1],
                band.last[2]});
  }
}

std::vector<TableColumn> band_columns() {
  std::vector<TableColumn> columns = {{"time", "s"},     {"band", ""},    {"cells", ""},
                                      {"volume", "m^3"}, {"length", "m"}, {"thickness", "m"},
                                      {"angle", "deg"},  {"mean", ""},    {"largest", ""}};
  for (const char* name :
       {"x", "y", "z", "first_x", "first_y", "first_z", "last_x", "last_y", "last_z"}) {
    columns.push_back({name, "m"});
  }
  return columns;
}

std::vector<Fact> facts_of(const std::vector<ShearBand>& bands, double threshold, double time) {
  std::vector<Fact> facts = {
      {"time", time, "s"}, {"threshold", threshold, ""}, {"bands", double(bands.size()), ""}};
  if (bands.empty()) return facts;
  facts.push_back({"largest_length", bands[0].length, "m"});
  facts.push_back({"largest_angle", bands[0].angle, "deg"});
  facts.push_back({"largest_thickness", bands[0].thickness, "m"});
  return facts;
}

/// The strain that was asked for, or the plastic one that the frames hold.
ParticleQuantity strain_of(const SlipOptions& options, const Run& run) {
  std::string field = options.field;
  for (const FieldInfo& info : run.fields()) {
    if (!field.empty()) break;
    const bool plastic =
        info.name == "equivalent_plastic_strain" || info.name == "equivalent_plastic_shear_strain";
    if (plastic) field = info.name;
  }
  if (field.empty()) {
    throw UserError(
        "the frames hold no plastic strain; ask for equivalent_plastic_shear_strain in "
        "output.fields, or name another strain with --field");
  }
  const auto wanted = quantities(field, run.fields(), run.dimension());
  if (wanted.size() == 1) return wanted[0];
  throw UserError("--field " + field + " has several components; name one, e.g. " +
                  wanted.front().name);
}

int run_slip(const SlipOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  const ParticleQuantity strain = strain_of(options, run);
  const double spacing = options.spacing.empty()
                             ? run.cell_size()
                             : parse_value("--spacing", options.spacing, Unit::length);
  if (!(spacing > 0)) throw UserError("--spacing must be above 0");
  const auto frames = chosen_frames(run.frames(), options.time);
  Report report;
  report.command = "slip";
  report.run = options.run;
  report.columns = band_columns();
  FrameProgress progress("frame", frames.size(), options.output.quiet);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const WeightedFrame frame = read_weighted(run, frames[i], needed_fields({strain}));
    if (frame.count() == 0) throw UserError("the frame holds no particles");
    const double time = frame.particles.time;
    const CellField field = cell_field(run, frame, values_of(strain, frame.particles), spacing);
    const double threshold = options.threshold > 0 ? options.threshold : default_threshold(field);
    const auto bands = shear_bands(run, field, threshold, std::size_t(options.least));
    add_rows(report, bands, time);
    if (i + 1 == frames.size()) {
      report.facts = facts_of(bands, threshold, time);
      draw(options, run, field, threshold, strain, time);
    }
    progress.done(i + 1);
  }
  OutputOptions rest = options.output;
  rest.plot.clear();  // drawn
  deliver(report, {}, "", "", rest);
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<SlipOptions>();
  SlipOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.text("--field", options.field, "F", "Strain that shows the bands (default: the plastic one)");
  set.number("--threshold", options.threshold, 0, 1e6, "S",
             "Of the strain (default: half of what 99 % of the cells stay below)");
  set.text("--spacing", options.spacing, "H", "Of the cells (default: the cell size)");
  set.whole_number("--least", options.least, 1, 1000000, "N",
                   "Cells that a band has at least (default: 5)");
  add_time_options(set, options.time, true);
  add_output_options(set, options.output);
  return [shared](const PostWords&) { return run_slip(*shared); };
}

}  // namespace

PostCommand post_slip() {
  return {"slip", "Shear bands: length, thickness and angle", false, &declare};
}

}  // namespace scree
