// SPDX-License-Identifier: Apache-2.0
// scree post compare: norms of the difference between two runs, or to an analytic solution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/run/quantity.hpp"
#include "solver/base/error.hpp"
#include "solver/deck/expression.hpp"

namespace scree {
namespace {

struct CompareOptions {
  std::string run, other, spacing;
  std::vector<std::string> fields, exact;
  double tolerance = 0;
  TimeOptions time;
  OutputOptions output;
};

/// Sums for the norms of a difference, weighted by volume.
struct Norms {
  double volume = 0, first = 0, second = 0, largest = 0, reference = 0;
  std::size_t count = 0;

  void add(double value, double reference_value, double weight) {
    const double d = std::abs(value - reference_value);
    volume += weight;
    first += weight * d;
    second += weight * d * d;
    largest = std::max(largest, d);
    reference += weight * reference_value * reference_value;
    ++count;
  }
  double l1() const { return first / volume; }
  double l2() const { return std::sqrt(second / volume); }
  double size() const { return std::sqrt(reference / volume); }
  /// Over the reference's own size; absolute where that is zero.
  double relative() const { return reference > 0 ? l2() / size() : l2(); }
};

std::vector<Norms> norms_by_id(const WeightedFrame& a, const WeightedFrame& b,
                               const std::vector<ParticleQuantity>& wanted) {
  std::vector<Norms> result(wanted.size());
  for (std::size_t q = 0; q < wanted.size(); ++q) {
    const auto of_a = values_of(wanted[q], a.particles), of_b = values_of(wanted[q], b.particles);
    for (std::size_t i = 0, j = 0; i < a.count() && j < b.count();) {
      const std::int64_t left = a.particles.id[i], right = b.particles.id[j];
      if (left == right) {
        if (std::isfinite(of_a[i]) && std::isfinite(of_b[j])) {
          result[q].add(of_a[i], of_b[j], a.volume[i]);
        }
        ++i, ++j;
      } else {
        left < right ? ++i : ++j;
      }
    }
  }
  return result;
}

using CellMeans = std::map<std::array<long, 3>, std::pair<double, double>>;  ///< volume, sum

CellMeans cell_means(const WeightedFrame& frame, const std::vector<double>& values,
                     const std::array<double, 3>& origin, double spacing, int dimension) {
  CellMeans cells;
  for (std::size_t p = 0; p < frame.count(); ++p) {
    if (!std::isfinite(values[p])) continue;
    std::array<long, 3> at{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
      at[a] = std::lround(std::floor((frame.place(p)[a] - origin[a]) / spacing));
    }
    auto& [volume, sum] = cells[at];
    volume += frame.volume[p];
    sum += frame.volume[p] * values[p];
  }
  return cells;
}

/// For runs whose particles differ: means over cells, where both have particles.
std::vector<Norms> norms_by_cell(const Run& run, const WeightedFrame& a, const WeightedFrame& b,
                                 const std::vector<ParticleQuantity>& wanted, double spacing) {
  std::vector<Norms> result(wanted.size());
  for (std::size_t q = 0; q < wanted.size(); ++q) {
    const CellMeans of_a =
        cell_means(a, values_of(wanted[q], a.particles), run.lower(), spacing, run.dimension());
    const CellMeans of_b =
        cell_means(b, values_of(wanted[q], b.particles), run.lower(), spacing, run.dimension());
    for (const auto& [at, left] : of_a) {
      const auto right = of_b.find(at);
      if (right == of_b.end()) continue;
      result[q].add(left.second / left.first, right->second.second / right->second.first,
                    left.first);
    }
  }
  return result;
}

/// Whether two runs began with the same particles in the same places.
bool same_particles(const Run& a, const Run& b) {
  const WeightedFrame first = read_weighted(a, 0, {}), second = read_weighted(b, 0, {});
  if (first.particles.id != second.particles.id) return false;
  const double room = 1e-6 * a.cell_size();  // frames may hold positions in single precision
  for (std::size_t i = 0; i < first.particles.position.size(); ++i) {
    if (std::abs(first.particles.position[i] - second.particles.position[i]) > room) return false;
  }
  return true;
}

/// A solution that was given for a quantity.
struct Exact {
  ParticleQuantity quantity;
  Expression expression;
};

std::vector<Exact> read_exact(const CompareOptions& options, const Run& run) {
  std::vector<Exact> result;
  for (const std::string& word : options.exact) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      throw UserError("--exact " + word + ": must be FIELD=EXPRESSION, e.g. velocity.x=sin(pi*x)");
    }
    const auto found = quantities(word.substr(0, equals), run.fields(), run.dimension());
    if (found.size() != 1) {
      throw UserError("--exact " + word + ": name one component, e.g. " + found.front().name);
    }
    result.push_back(
        {found.front(), Expression(word.substr(equals + 1), {"x", "y", "z", "X", "Y", "Z", "t"})});
  }
  return result;
}

/// The place of each particle in the first frame, by id.
std::map<std::int64_t, std::array<double, 3>> first_places(const Run& run) {
  const WeightedFrame first = read_weighted(run, 0, {});
  std::map<std::int64_t, std::array<double, 3>> places;
  for (std::size_t p = 0; p < first.count(); ++p) {
    const double* x = first.place(p);
    places[first.particles.id[p]] = {x[0], x[1], x[2]};
  }
  return places;
}

void add_row(Report& report, double time, const std::string& name, const Norms& norms) {
  if (norms.count == 0) {
    throw UserError(fmt::format("nothing to compare at t = {:g} s for {}", time, name));
  }
  report.rows.push_back({time, name, norms.l1(), norms.l2(), norms.largest, norms.size(),
                         norms.relative(), double(norms.count)});
}

void compare_exact(const CompareOptions& options, const Run& run, Report& report) {
  const std::vector<Exact> exact = read_exact(options, run);
  std::vector<ParticleQuantity> wanted;
  for (const Exact& one : exact) wanted.push_back(one.quantity);
  const auto places = first_places(run);
  const auto frames = chosen_frames(run.frames(), options.time);
  FrameProgress progress("frame", frames.size(), options.output.quiet);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const WeightedFrame frame = read_weighted(run, frames[i], needed_fields(wanted));
    for (const Exact& one : exact) {
      const std::vector<double> values = values_of(one.quantity, frame.particles);
      Norms norms;
      for (std::size_t p = 0; p < frame.count(); ++p) {
        if (!std::isfinite(values[p])) continue;
        const double* x = frame.place(p);
        const auto first = places.find(frame.particles.id[p]);
        if (first == places.end()) throw UserError("a particle is not in the first frame");
        const auto& X = first->second;
        const double variables[7] = {x[0], x[1], x[2], X[0], X[1], X[2], frame.particles.time};
        const double expected = one.expression(variables);
        if (!std::isfinite(expected)) {
          throw UserError(fmt::format("--exact {} is not finite at ({:g}, {:g}, {:g}), t = {:g}",
                                      one.quantity.name, x[0], x[1], x[2], variables[6]));
        }
        norms.add(values[p], expected, frame.volume[p]);
      }
      add_row(report, frame.particles.time, one.quantity.name, norms);
    }
    progress.done(i + 1);
  }
  report.facts.push_back({"against", std::string("the given expressions"), ""});
}

/// The default of --fields: what both runs have.
std::vector<std::string> common_fields(const CompareOptions& options, const Run& a, const Run& b) {
  if (!options.fields.empty()) return options.fields;
  std::vector<std::string> names;
  for (const FieldInfo& field : a.fields()) {
    for (const FieldInfo& other : b.fields()) {
      if (field.name == other.name) names.push_back(field.name);
    }
  }
  names.push_back("position");
  return names;
}

void compare_runs(const CompareOptions& options, const Run& run, Report& report) {
  const Run other(options.other);
  if (other.dimension() != run.dimension()) {
    throw UserError("the runs have different dimensions");
  }
  const auto words = common_fields(options, run, other);
  const auto wanted = quantities(words, run.fields(), run.dimension());
  quantities(words, other.fields(), run.dimension());  // the other run must have them, too
  const bool matched = options.spacing.empty() && same_particles(run, other);
  const double spacing = options.spacing.empty()
                             ? std::max(run.cell_size(), other.cell_size())
                             : parse_value("--spacing", options.spacing, Unit::length);
  if (!(spacing > 0)) throw UserError("--spacing must be above 0");
  const auto frames = chosen_frames(run.frames(), options.time);
  FrameProgress progress("frame", frames.size(), options.output.quiet);
  double farthest = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double time = run.frames().times()[frames[i]];
    TimeOptions same;
    same.time = fmt::format("{}", time);
    const std::size_t partner = chosen_frames(other.frames(), same).front();
    farthest = std::max(farthest, std::abs(other.frames().times()[partner] - time));
    const WeightedFrame a = read_weighted(run, frames[i], needed_fields(wanted));
    const WeightedFrame b = read_weighted(other, partner, needed_fields(wanted));
    const auto norms =
        matched ? norms_by_id(a, b, wanted) : norms_by_cell(run, a, b, wanted, spacing);
    for (std::size_t q = 0; q < wanted.size(); ++q) add_row(report, time, wanted[q].name, norms[q]);
    progress.done(i + 1);
  }
  report.facts.push_back({"against", options.other, ""});
  report.facts.push_back({"matched",
                          matched ? std::string("particle by particle")
                                  : fmt::format("means over cells of {:g} m", spacing),
                          ""});
  if (farthest > 1e-9 * std::abs(run.frames().times().back())) {
    report.remarks.push_back(
        fmt::format("the frames of the runs are up to {:.3g} s apart", farthest));
  }
}

/// The largest relative difference of all rows and where it is.
void add_worst(Report& report) {
  double worst = -1;
  std::string name;
  for (const auto& row : report.rows) {
    if (std::get<double>(row[6]) <= worst) continue;
    worst = std::get<double>(row[6]);
    name = std::get<std::string>(row[1]);
  }
  report.facts.push_back({"largest_relative_l2", worst, ""});
  report.facts.push_back({"of", name, ""});
}

std::vector<Chart> charts_of(const Report& report) {
  Chart chart;
  chart.x_label = "Time (s)";
  chart.y_label = "Relative L2 difference";
  std::map<std::string, std::size_t> index;
  for (const auto& row : report.rows) {
    const std::string& name = std::get<std::string>(row[1]);
    const auto [at, fresh] = index.emplace(name, index.size());
    if (fresh) {
      chart.curves.emplace_back();
      chart.curves.back().name = name;
      chart.curves.back().colour = curve_colour(at->second);
    }
    chart.curves[at->second].x.push_back(std::get<double>(row[0]));
    chart.curves[at->second].y.push_back(std::get<double>(row[6]));
  }
  for (Curve& curve : chart.curves) curve.start = curve.x.size() == 1;
  return {chart};
}

int run_compare(const CompareOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  if (options.other.empty() == options.exact.empty()) {
    throw UserError("name either a second run or --exact FIELD=EXPRESSION");
  }
  if (!options.exact.empty() && !options.fields.empty()) {
    throw UserError("--fields belongs to two runs; --exact names its own");
  }
  Report report;
  report.command = "compare";
  report.run = options.run;
  report.columns = {{"time", "s"}, {"quantity", ""},     {"l1", ""},          {"l2", ""},
                    {"linf", ""},  {"reference_l2", ""}, {"relative_l2", ""}, {"samples", ""}};
  if (options.exact.empty()) {
    compare_runs(options, run, report);
  } else {
    compare_exact(options, run, report);
  }
  add_worst(report);
  deliver(report, charts_of(report), run.title(), "Difference, volume-weighted", options.output);
  const double worst = std::get<double>(report.facts[report.facts.size() - 2].value);
  if (options.tolerance > 0 && worst > options.tolerance) {
    throw RunFault(fmt::format("the relative difference {:.4g} of {} is above the tolerance {:g}",
                               worst, std::get<std::string>(report.facts.back().value),
                               options.tolerance));
  }
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<CompareOptions>();
  CompareOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.positional("other", options.other, "OTHER", "Second run folder, the reference", false);
  set.texts("--fields,--field", options.fields, "F,F,...",
            "Of two runs (default: all that both have, and the position)");
  set.repeated("--exact", options.exact, "FIELD=EXPRESSION",
               "A solution in x, y, z, X, Y, Z (place in the first frame) and t; repeatable");
  set.text("--spacing", options.spacing, "H",
           "Compare means over cells of this size (default: particle by particle where the runs "
           "began alike, else the larger cell size)");
  set.number("--tolerance", options.tolerance, 0, 1e300, "R",
             "End with status 1 where a relative L2 difference is larger");
  add_time_options(set, options.time, true);
  add_output_options(set, options.output);
  return [shared](const PostWords&) { return run_compare(*shared); };
}

}  // namespace

PostCommand post_compare() {
  return {"compare", "Norms between two runs, or to an analytic solution", false, &declare};
}

}  // namespace scree
