// SPDX-License-Identifier: Apache-2.0
// scree post runout: front, height and outline of a deposit over time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/runout/deposit.hpp"
#include "postproc/runout/scaling_laws.hpp"
#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

struct RunoutOptions {
  std::string run, direction, origin, base, outline;
  std::vector<std::string> axis, laws;
  double share = 0.995;
  OutputOptions output;
};

using Bounds = std::array<std::array<double, 2>, 3>;

/// The box around all particles, their halves included.
Bounds bounds_of(const WeightedFrame& frame, const std::vector<double>& half_spacing,
                 int dimension) {
  Bounds bounds{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    bounds[a] = {frame.place(0)[a], frame.place(0)[a]};
    for (std::size_t p = 0; p < frame.count(); ++p) {
      bounds[a][0] = std::min(bounds[a][0], frame.place(p)[a] - half_spacing[p]);
      bounds[a][1] = std::max(bounds[a][1], frame.place(p)[a] + half_spacing[p]);
    }
  }
  return bounds;
}

/// The horizontal direction in which the body spreads most between two frames.
Direction spreading(const Run& run, const Bounds& first, const Bounds& last) {
  Direction best{run.up().axis == 0 ? 1 : 0, 1};
  double most = -1;
  for (int axis = 0; axis < run.dimension(); ++axis) {
    if (axis == run.up().axis) continue;
    const auto a = static_cast<std::size_t>(axis);
    const double up = last[a][1] - first[a][1], down = first[a][0] - last[a][0];
    if (up > most) best = {axis, 1}, most = up;
    if (down > most) best = {axis, -1}, most = down;
  }
  return best;
}

/// Where distances start: the body's back where that stays in its place, as at a wall or a plane
/// of symmetry, else its middle.
double start_of(const Run& run, const Bounds& first, const Bounds& last, Direction along) {
  const auto a = static_cast<std::size_t>(along.axis);
  const std::size_t back = along.sign > 0 ? 0 : 1;
  const bool fixed = std::abs(last[a][back] - first[a][back]) <= run.cell_size();
  return fixed ? first[a][back] : 0.5 * (first[a][0] + first[a][1]);
}

Measure choose_measure(const RunoutOptions& options, const Run& run, const Bounds& first,
                       const Bounds& last) {
  Measure result;
  result.up = run.up();
  result.share = options.share;
  const auto up = static_cast<std::size_t>(run.up().axis);
  result.base = run.up().sign > 0 ? first[up][0] : first[up][1];
  if (!options.base.empty()) result.base = parse_value("--base", options.base, Unit::length);
  result.radial = options.direction == "radial";
  if (result.radial && run.dimension() == 2) {
    throw UserError("--direction radial needs a run in three dimensions");
  }
  if (result.radial) {
    if (!options.origin.empty()) throw UserError("--origin is a line; with radial give --axis");
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      result.origin[a] = start_of(run, first, last, {axis, 1});
      // A quarter or half model may lie on the other side of its plane of symmetry.
      const double other = start_of(run, first, last, {axis, -1});
      if (std::abs(last[a][0] - first[a][0]) > run.cell_size()) result.origin[a] = other;
    }
    if (!options.axis.empty()) result.origin = parse_point("--axis", options.axis, 3);
    return result;
  }
  if (!options.axis.empty()) throw UserError("--axis belongs to --direction radial");
  result.along = options.direction.empty()
                     ? spreading(run, first, last)
                     : parse_direction("--direction", options.direction, run.dimension());
  if (result.along.axis == run.up().axis) throw UserError("--direction must be horizontal");
  double& origin = result.origin[static_cast<std::size_t>(result.along.axis)];
  origin = options.origin.empty() ? start_of(run, first, last, result.along)
                                  : parse_value("--origin", options.origin, Unit::length);
  return result;
}

void add_facts(Report& report, const Measure& measure, const Extent& first, const Extent& last) {
  const std::string axis(1, "xyz"[measure.along.axis]);
  report.facts = {
      {"direction", measure.radial ? "radial" : (measure.along.sign > 0 ? "+" : "-") + axis, ""},
      {"origin", measure.origin[static_cast<std::size_t>(measure.along.axis)], "m"},
      {"initial_front", first.farthest, "m"},
      {"initial_height", first.height, "m"},
      {"aspect_ratio", first.height / first.farthest, ""},
      {"final_front", last.front, "m"},
      {"final_farthest", last.farthest, "m"},
      {"final_height", last.height, "m"},
      {"runout", last.front - first.farthest, "m"},
      {"normalised_runout", (last.front - first.farthest) / first.farthest, ""},
      {"normalised_height", last.height / first.farthest, ""}};
}

/// What the laws predict beside the run. They hold for dry columns that stand at a wall, or are
/// round.
void add_laws(Report& report, const RunoutOptions& options, const Run& run, const Measure& measure,
              const Extent& first) {
  const double d0 = first.farthest, a = first.height / d0;
  for (const std::string& word : options.laws) {
    const ScalingLaw law = word == "lube" ? lube(a, measure.radial) : lajeunesse(a, measure.radial);
    report.facts.push_back({word + "_front", d0 * (1 + law.runout), "m"});
    report.facts.push_back({word + "_normalised_runout", law.runout, ""});
    report.facts.push_back({word + "_height", d0 * law.height, "m"});
    report.remarks.push_back(fmt::format(
        "{}: front {:.4g} m, height {:.4g} m for a = {:.3g}; experiments scatter by about 10 %",
        law.name, d0 * (1 + law.runout), d0 * law.height, a));
  }
  const auto gravity = run.gravity(0);
  const double g = std::abs(gravity[static_cast<std::size_t>(measure.up.axis)]);
  if (!options.laws.empty() && g > 0) {
    report.facts.push_back({"collapse_time", collapse_time(first.height, g), "s"});
  }
}

std::vector<Chart> charts_of(const Report& report, const RunoutOptions& options,
                             const Measure& measure, const std::vector<OutlinePoint>& outline) {
  Chart over_time;
  over_time.x_label = "Time (s)";
  over_time.y_label = "Distance, height (m)";
  const std::vector<std::pair<std::size_t, std::string>> lines = {
      {1, fmt::format("front, {:g} %", 100 * options.share)}, {2, "farthest"}, {4, "height"}};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Curve curve;
    curve.x = report.numbers(0);
    curve.y = report.numbers(lines[i].first);
    curve.name = lines[i].second;
    curve.colour = curve_colour(i);
    over_time.curves.push_back(curve);
  }
  for (const std::string& law : options.laws) {
    for (const Fact& fact : report.facts) {
      if (fact.name != law + "_front") continue;
      Curve curve;
      curve.x = {over_time.curves[0].x.front(), over_time.curves[0].x.back()};
      curve.y.assign(2, std::get<double>(fact.value));
      curve.name = law + ", final front";
      curve.dashed = true;
      curve.colour = curve_colour(law == "lube" ? 3 : 5);
      over_time.curves.push_back(curve);
    }
  }
  Chart shape;
  shape.x_label = measure.radial ? "Angle (deg)" : "Distance (m)";
  shape.y_label = measure.radial ? "Front (m)" : "Height (m)";
  Curve curve;
  for (const OutlinePoint& point : outline) {
    curve.x.push_back(point.distance);
    curve.y.push_back(point.value);
  }
  curve.name = "outline at the end";
  shape.curves = {curve};
  return {over_time, shape};
}

void write_outline(const RunoutOptions& options, const Measure& measure,
                   const std::vector<OutlinePoint>& points) {
  if (options.outline.empty()) return;
  std::string text = measure.radial ? "angle,front\n" : "distance,height\n";
  for (const OutlinePoint& p : points) text += fmt::format("{},{}\n", p.distance, p.value);
  replace_file(options.outline, text);
}

int run_runout(const RunoutOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  if (!options.outline.empty()) check_target(options.outline, run);
  const std::size_t count = run.frames().times().size();
  WeightedFrame frame = read_weighted(run, 0, {});
  if (frame.count() == 0) throw UserError("the first frame holds no particles");
  std::vector<double> half = half_spacings(run, frame.particles);
  const Bounds first = bounds_of(frame, half, run.dimension());
  frame = read_weighted(run, count - 1, {});
  if (frame.count() == 0) throw UserError("the last frame holds no particles");
  half = half_spacings(run, frame.particles);
  const Bounds last = bounds_of(frame, half, run.dimension());
  const Measure measured = choose_measure(options, run, first, last);
  Report report;
  report.command = "runout";
  report.run = options.run;
  report.columns = {{"time", "s"},   {"front", "m"},  {"farthest", "m"},     {"back", "m"},
                    {"height", "m"}, {"centre", "m"}, {"centre_height", "m"}};
  std::vector<Extent> extents;
  FrameProgress progress("frame", count, options.output.quiet);
  for (std::size_t i = 0; i < count; ++i) {
    frame = read_weighted(run, i, {});
    if (frame.count() == 0) continue;
    half = half_spacings(run, frame.particles);
    const Extent e = measure(measured, frame, half);
    report.add({e.time, e.front, e.farthest, e.back, e.height, e.centre, e.centre_height});
    extents.push_back(e);
    progress.done(i + 1);
  }
  add_facts(report, measured, extents.front(), extents.back());
  add_laws(report, options, run, measured, extents.front());
  const auto points = outline(measured, frame, half, run.cell_size());
  write_outline(options, measured, points);
  deliver(report, charts_of(report, options, measured, points), run.title(),
          fmt::format("Front, height and final outline, {}", time_text(extents.back().time)),
          options.output);
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<RunoutOptions>();
  RunoutOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.text("--direction", options.direction, "D",
           "Of the front: x, -x, ..., or radial about an upright axis (default: the horizontal "
           "direction of the largest spread)");
  set.text("--origin", options.origin, "X",
           "Coordinate that distances start from (default: the back of the body if it stays in "
           "place, else its middle)");
  set.texts("--axis", options.axis, "X Y Z", "A point of the axis of a radial spread", 3, 3);
  set.text("--base", options.base, "H", "Height that counts as zero (default: the body's foot)");
  set.number("--share", options.share, 0.5, 1, "S",
             "Of the volume that lies behind the front (default: 0.995)");
  set.choices("--law", options.laws, {"lube", "lajeunesse"},
              "Compare with scaling laws of column collapse");
  set.text("--outline", options.outline, "FILE.csv", "Write the final outline there");
  add_output_options(set, options.output);
  return [shared](const PostWords&) { return run_runout(*shared); };
}

}  // namespace

PostCommand post_runout() {
  return {"runout", "Front, height and outline of a deposit over time", false, &declare};
}

}  // namespace scree
