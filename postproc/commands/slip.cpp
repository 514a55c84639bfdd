// SPDX-License-Identifier: Apache-2.0
// scree post slip: shear bands, where a strain is above a threshold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/plot/heat_map.hpp"
#include "postproc/run/quantity.hpp"
#include "postproc/slip/bands.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

struct SlipOptions {
  std::string run, field = "equivalent_plastic_strain", spacing;
  double threshold = 0;
  int least = 5;
  TimeOptions time;
  OutputOptions output;
};

/// Cells above the threshold in their colours, the others at its low end; runs in 2D.
void draw(const SlipOptions& options, const Run& run, const CellField& field, double threshold,
          const ParticleQuantity& quantity, double time) {
  if (options.output.plot.empty()) return;
  if (run.dimension() == 3) {
    throw UserError("--plot of slip needs a run in two dimensions; in three take section");
  }
  HeatMap map;
  std::array<long, 2> low{field.cells[0].at[0], field.cells[0].at[1]}, high = low;
  for (const CellField::Cell& cell : field.cells) {
    for (std::size_t a = 0; a < 2; ++a) {
      low[a] = std::min(low[a], cell.at[a]);
      high[a] = std::max(high[a], cell.at[a]);
    }
    map.high = std::max(map.high, cell.mean);
  }
  map.low = threshold;
  map.columns = static_cast<std::size_t>(high[0] - low[0] + 1);
  map.rows = static_cast<std::size_t>(high[1] - low[1] + 1);
  map.values.assign(map.columns * map.rows, std::numeric_limits<double>::quiet_NaN());
  for (const CellField::Cell& cell : field.cells) {
    map.values[static_cast<std::size_t>(cell.at[1] - low[1]) * map.columns +
               static_cast<std::size_t>(cell.at[0] - low[0])] = std::max(cell.mean, threshold);
  }
  const auto edge = [&](std::size_t axis, long index) {
    return run.lower()[axis] + field.spacing * static_cast<double>(index);
  };
  map.x_low = edge(0, low[0]);
  map.x_high = edge(0, high[0] + 1);
  map.y_low = edge(1, low[1]);
  map.y_high = edge(1, high[1] + 1);
  map.x_label = "x (m)";
  map.y_label = "y (m)";
  map.value_label = "Strain";
  map.title = run.title();
  map.subtitle =
      fmt::format("{} above {:.4g}, {}", axis_label(quantity.name, ""), threshold, time_text(time));
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

int run_slip(const SlipOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  const auto wanted = quantities(options.field, run.fields(), run.dimension());
  if (wanted.size() != 1) {
    throw UserError("--field " + options.field + " has several components; name one, e.g. " +
                    wanted.front().name);
  }
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
    const WeightedFrame frame = read_weighted(run, frames[i], needed_fields(wanted));
    if (frame.count() == 0) throw UserError("the frame holds no particles");
    const double time = frame.particles.time;
    const CellField field = cell_field(run, frame, values_of(wanted[0], frame.particles), spacing);
    const double threshold = options.threshold > 0 ? options.threshold : default_threshold(field);
    const auto bands = shear_bands(run, field, threshold, std::size_t(options.least));
    add_rows(report, bands, time);
    if (i + 1 == frames.size()) {
      report.facts = facts_of(bands, threshold, time);
      draw(options, run, field, threshold, wanted[0], time);
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
  set.text("--field", options.field, "F",
           "Strain that shows the bands (default: equivalent_plastic_strain)");
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
