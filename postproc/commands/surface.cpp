// SPDX-License-Identifier: Apache-2.0
// scree post surface: the free surface as a level of the filled volume.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/plot/heat_map.hpp"
#include "postproc/surface/level_set.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

struct SurfaceOptions {
  std::string run, spacing, mesh;
  TimeOptions time;
  OutputOptions output;
};

/// The heights over the two horizontal axes of a run in three dimensions.
void draw_heights(const SurfaceOptions& options, const Run& run, const Lattice& lattice,
                  const std::vector<SurfacePoint>& points, double time) {
  const auto up = static_cast<std::size_t>(run.up().axis);
  const std::size_t across = up == 0 ? 1 : 0, upward = up == 2 ? 1 : 2;
  HeatMap map;
  map.columns = static_cast<std::size_t>(lattice.nodes(static_cast<int>(across)));
  map.rows = static_cast<std::size_t>(lattice.nodes(static_cast<int>(upward)));
  map.values.assign(map.columns * map.rows, std::numeric_limits<double>::quiet_NaN());
  const double h = lattice.spacing;
  for (const SurfacePoint& point : points) {
    const auto i = std::lround((point.place[across] - lattice.origin[across]) / h);
    const auto j = std::lround((point.place[upward] - lattice.origin[upward]) / h);
    map.values[static_cast<std::size_t>(j) * map.columns + static_cast<std::size_t>(i)] =
        point.height;
  }
  map.x_low = lattice.origin[across] - 0.5 * h;
  map.x_high = map.x_low + h * static_cast<double>(map.columns);
  map.y_low = lattice.origin[upward] - 0.5 * h;
  map.y_high = map.y_low + h * static_cast<double>(map.rows);
  map.x_label = fmt::format("{} (m)", "xyz"[across]);
  map.y_label = fmt::format("{} (m)", "xyz"[upward]);
  map.value_label = "Height (m)";
  map.title = run.title();
  map.subtitle = fmt::format("Free surface, {}", time_text(time));
  write_heat_map(options.output.plot, "scree post surface", map);
}

Curve curve_of(const std::vector<SurfacePoint>& points, std::size_t across, double time,
               std::size_t index, bool named) {
  Curve curve;
  for (const SurfacePoint& point : points) {
    curve.x.push_back(point.place[across]);
    curve.y.push_back(point.height);
  }
  curve.colour = curve_colour(index);
  if (named) curve.name = fmt::format("{:.4g} s", time);
  return curve;
}

/// Checks the file of the mesh, which shows one frame.
void check_mesh(const SurfaceOptions& options, const Run& run, std::size_t frames) {
  if (options.mesh.empty()) return;
  if (extension_of(options.mesh) != "vtp") {
    throw UserError("--mesh " + options.mesh + ": the name must end in .vtp");
  }
  if (frames > 1) throw UserError("--mesh takes one frame, not several");
  check_target(options.mesh, run);
}

/// Adds the surface of a frame to the table; returns its points.
std::vector<SurfacePoint> add_rows(Report& report, const LevelSet& level, const Run& run,
                                   double time) {
  std::vector<SurfacePoint> points = free_surface(level, run.up());
  for (const SurfacePoint& point : points) {
    report.add({time, point.place[0], point.place[1], point.place[2], point.height});
  }
  return points;
}

void add_facts(Report& report, const SurfaceOptions& options, const LevelSet& level,
               const std::vector<SurfacePoint>& points, double time) {
  double highest = std::numeric_limits<double>::lowest();
  for (const SurfacePoint& point : points) highest = std::max(highest, point.height);
  const SurfaceMeasure measure = write_surface(level, options.mesh);
  const bool flat = level.lattice.dimension == 2;
  report.facts = {{"time", time, "s"},
                  {"spacing", level.lattice.spacing, "m"},
                  {"highest", highest, "m"},
                  {flat ? "length" : "area", measure.size, flat ? "m" : "m^2"}};
}

int run_surface(const SurfaceOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  const auto frames = chosen_frames(run.frames(), options.time);
  check_mesh(options, run, frames.size());
  const double spacing = options.spacing.empty()
                             ? run.cell_size()
                             : parse_value("--spacing", options.spacing, Unit::length);
  if (!(spacing > 0)) throw UserError("--spacing must be above 0");
  const std::size_t across = run.up().axis == 0 ? 1 : 0;
  Report report{"surface", options.run, {}, {}, {}, {}};
  report.columns = {{"time", "s"}, {"x", "m"}, {"y", "m"}, {"z", "m"}, {"height", "m"}};
  Chart chart;
  chart.x_label = fmt::format("{} (m)", "xyz"[across]);
  chart.y_label = "Height of the free surface (m)";
  FrameProgress progress("frame", frames.size(), options.output.quiet);
  const bool drawn = run.dimension() == 3 && !options.output.plot.empty();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const WeightedFrame frame = read_weighted(run, frames[i], {});
    if (frame.count() == 0) throw UserError("the frame holds no particles");
    const double time = frame.particles.time;
    const LevelSet level = volume_fraction(run, frame, spacing);
    const auto points = add_rows(report, level, run, time);
    const bool named = frames.size() > 1 && frames.size() <= 8;
    chart.curves.push_back(curve_of(points, across, time, i, named));
    progress.done(i + 1);
    if (i + 1 < frames.size()) continue;
    add_facts(report, options, level, points, time);
    if (drawn) draw_heights(options, run, level.lattice, points, time);
  }
  OutputOptions rest = options.output;
  if (drawn) rest.plot.clear();
  deliver(report, {chart}, run.title(), "Free surface", rest);
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<SurfaceOptions>();
  SurfaceOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.text("--spacing", options.spacing, "H", "Of the nodes (default: the cell size)");
  set.text("--mesh", options.mesh, "FILE.vtp", "Write the whole surface, lines or triangles");
  add_time_options(set, options.time, true);
  add_output_options(set, options.output);
  return [shared](const PostWords&) { return run_surface(*shared); };
}

}  // namespace

PostCommand post_surface() {
  return {"surface", "Height and mesh of the free surface", false, &declare};
}

}  // namespace scree
