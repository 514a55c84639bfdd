// SPDX-License-Identifier: Apache-2.0
// scree post history: the columns of history.csv as diagrams and tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "postproc/colliders/run_colliders.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/run/history_column.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

struct HistoryOptions {
  std::string run, against = "time", from, to;
  std::vector<std::string> columns;
  OutputOptions output;
};

bool all_zero(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return x == 0; });
}

std::vector<std::string> collider_names(const Run& run) {
  std::vector<std::string> names;
  if (const Value* colliders = run.deck().find("collider")) {
    for (const Value& collider : colliders->items) names.push_back(collider.key);
  }
  return names;
}

/// Adds the ways of the colliders that move, which the deck prescribes: NAME_displacement_x, ...
void add_displacements(const Run& run, History& history) {
  const std::vector<double> times = history.at("time");
  for (const RunCollider& collider : run_colliders(run, times)) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(run.dimension()); ++a) {
      std::vector<double> way;
      for (std::size_t k = 0; k < times.size(); ++k) way.push_back(collider.displacement(k)[a]);
      if (all_zero(way)) continue;
      const std::string name = collider.name() + "_displacement_" + "xyz"[a];
      history.names.push_back(name);
      history.columns[name] = std::move(way);
    }
  }
}

/// What is worth a look in any run: energies, momenta, water, forces. Columns that stay zero are
/// left out.
std::vector<std::string> default_columns(const History& history, const Run& run) {
  std::vector<std::string> chosen;
  for (const char* name : {"kinetic_energy", "elastic_energy", "external_work"}) {
    if (history.has(name)) chosen.emplace_back(name);
  }
  const auto add = [&](const std::string& name) {
    if (history.has(name) && !all_zero(history.at(name))) chosen.push_back(name);
  };
  for (const char* axis : {"x", "y", "z"}) add(std::string("momentum_") + axis);
  for (const char* name : {"fluid_mass", "fluid_outflow", "fluid_balance_error"}) add(name);
  for (const std::string& collider : collider_names(run)) {
    for (const char* axis : {"x", "y", "z"}) add(collider + "_force_" + axis);
    add(collider + "_work");
  }
  return chosen;
}

/// The columns for a word: a column, or all whose names begin with the word and an underscore.
std::vector<std::string> columns_of(const std::string& option, const std::string& word,
                                    const History& history) {
  if (history.has(word)) return {word};
  std::vector<std::string> found;
  for (const std::string& name : history.names) {
    if (name.rfind(word + "_", 0) == 0) found.push_back(name);
  }
  if (!found.empty()) return found;
  const std::string near = did_you_mean(word, history.names);
  throw UserError(fmt::format("{} {}: history.csv has no such column{}; it has {}", option, word,
                              near.empty() ? "" : ", did you mean " + near + "?",
                              join(history.names)));
}

/// One diagram a kind of column, in the order of the columns.
std::vector<Chart> charts_of(const Report& report, const Run& run) {
  const std::vector<std::string> colliders = collider_names(run);
  std::vector<Chart> charts;
  std::vector<std::string> titles;
  for (std::size_t c = 1; c < report.columns.size(); ++c) {
    const HistoryKind kind = history_kind(report.columns[c].name, colliders, run.dimension());
    const std::string title = kind.unit.empty() ? kind.title : kind.title + " (" + kind.unit + ")";
    std::size_t at =
        static_cast<std::size_t>(std::find(titles.begin(), titles.end(), title) - titles.begin());
    if (at == titles.size()) {
      titles.push_back(title);
      charts.emplace_back();
      charts[at].x_label = axis_label(report.columns[0].name, report.columns[0].unit);
      charts[at].y_label = title;
    }
    Curve curve;
    curve.x = report.numbers(0);
    curve.y = report.numbers(c);
    curve.name = report.columns[c].name;
    std::replace(curve.name.begin(), curve.name.end(), '_', ' ');
    curve.colour = curve_colour(charts[at].curves.size());
    charts[at].curves.push_back(curve);
  }
  return charts;
}

Report report_of(const HistoryOptions& options, const Run& run, const History& history) {
  Report report;
  report.command = "history";
  report.run = options.run;
  std::vector<std::string> chosen;
  for (const std::string& word : options.columns) {
    for (const std::string& name : columns_of("--columns", word, history)) chosen.push_back(name);
  }
  if (options.columns.empty()) chosen = default_columns(history, run);
  const std::vector<std::string> along = columns_of("--against", options.against, history);
  if (along.size() != 1) {
    throw UserError("--against " + options.against + ": name one of " + join(along));
  }
  chosen.erase(std::remove(chosen.begin(), chosen.end(), along[0]), chosen.end());
  chosen.insert(chosen.begin(), along[0]);
  for (const std::string& name : chosen) {
    report.columns.push_back({name, history_kind(name, collider_names(run), run.dimension()).unit});
  }
  const double from =
      options.from.empty() ? -HUGE_VAL : parse_value("--from", options.from, Unit::time);
  const double to = options.to.empty() ? HUGE_VAL : parse_value("--to", options.to, Unit::time);
  for (std::size_t i = 0; i < history.rows(); ++i) {
    const double time = history.at("time")[i];
    if (time < from || time > to) continue;
    std::vector<double> row;
    for (const std::string& name : chosen) row.push_back(history.at(name)[i]);
    report.add(row);
  }
  if (report.rows.empty()) {
    throw UserError(
        fmt::format("the history has no rows between --from and --to; it goes from "
                    "{:g} to {:g} s",
                    history.at("time").front(), history.at("time").back()));
  }
  return report;
}

/// The largest magnitude of each column and when it was reached.
void add_extremes(Report& report) {
  for (std::size_t c = 1; c < report.columns.size(); ++c) {
    const std::vector<double> values = report.numbers(c);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    report.facts.push_back({report.columns[c].name + "_min", *low, report.columns[c].unit});
    report.facts.push_back({report.columns[c].name + "_max", *high, report.columns[c].unit});
    report.facts.push_back(
        {report.columns[c].name + "_end", values.back(), report.columns[c].unit});
  }
}

int run_history(HistoryOptions options) {
  const Run run(options.run);
  // A picture may be named by -o, too.
  const std::string kind = extension_of(options.output.table);
  const bool picture_only = options.output.plot.empty() && (kind == "png" || kind == "svg");
  if (picture_only) std::swap(options.output.plot, options.output.table);
  check_targets(options.output, run);
  History history = read_history(run.folder());
  if (!history.has("time")) {
    throw UserError((run.folder() / "history.csv").string() + " has no column time");
  }
  add_displacements(run, history);
  Report report = report_of(options, run, history);
  add_extremes(report);
  const std::vector<Chart> charts = charts_of(report, run);
  const std::string subtitle = fmt::format("history.csv, {} rows", report.rows.size());
  if (picture_only && !options.output.json) {
    write_page(options.output.plot, "scree post history", run.title(), subtitle, charts);
    if (!options.output.quiet) fmt::print("{}", to_text(report));
    return 0;
  }
  deliver(report, charts, run.title(), subtitle, options.output);
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<HistoryOptions>();
  set.positional("run", shared->run, "RUN", "Run folder");
  set.texts("--columns", shared->columns, "C,C,...",
            "Columns, or how several begin: momentum, wall_force (default: energies, momenta, "
            "water, forces on colliders, as far as they are not zero)");
  set.text("--against", shared->against, "C", "Column along the axis (default: time)");
  set.text("--from", shared->from, "T", "First time (default: all)");
  set.text("--to", shared->to, "T", "Last time");
  add_output_options(set, shared->output);
  set.footer(
      "The ways of moving colliders are columns, too: NAME_displacement_x, ...\n"
      "  scree post history runs/strip_footing --columns footing_force_y --against "
      "footing_displacement_y --plot curve.png\n"
      "-o may name the picture: -o plot.png.");
  return [shared](const PostWords&) { return run_history(*shared); };
}

}  // namespace

PostCommand post_history() {
  return {"history", "Energies, momenta, water and forces over time", false, &declare};
}

}  // namespace scree
