// SPDX-License-Identifier: Apache-2.0
// scree post energy: the balance of work and energy from the history of a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "solver/base/error.hpp"
#include "solver/deck/expression.hpp"

namespace scree {
namespace {

struct EnergyOptions {
  std::string run;
  OutputOptions output;
};

constexpr std::array<const char*, 3> axes = {"x", "y", "z"};

/// Work done since the first row, of a power given at the rows (trapezoidal rule).
std::vector<double> accumulated(const std::vector<double>& time, const std::vector<double>& power) {
  std::vector<double> work(time.size(), 0.0);
  for (std::size_t i = 1; i < time.size(); ++i) {
    work[i] = work[i - 1] + 0.5 * (power[i] + power[i - 1]) * (time[i] - time[i - 1]);
  }
  return work;
}

/// Work of gravity [J]: sum of m g . dx of the centre of mass, g between rows by its mean. Exact
/// for constant gravity as long as the mass stays the same.
std::vector<double> gravity_work(const Run& run, const History& history) {
  const std::vector<double>& time = history.at("time");
  const std::vector<double>& mass = history.at("mass");
  std::vector<double> work(time.size(), 0.0);
  auto before = run.gravity(time[0]);
  for (std::size_t i = 1; i < time.size(); ++i) {
    const auto now = run.gravity(time[i]);
    work[i] = work[i - 1];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::vector<double>& centre = history.at(std::string("center_") + axes[a]);
      work[i] +=
          0.5 * (mass[i] + mass[i - 1]) * 0.5 * (now[a] + before[a]) * (centre[i] - centre[i - 1]);
    }
    before = now;
  }
  return work;
}

bool sums_collider_work(const Run& run, const History& history) {
  const Value* colliders = run.deck().find("collider");
  return colliders == nullptr ||
         std::all_of(colliders->items.begin(), colliders->items.end(),
                     [&](const Value& collider) { return history.has(collider.key + "_work"); });
}

/// The velocity of a collider at a time [m/s]; numbers or expressions of t.
std::array<double, 3> velocity_of(const Value& collider, double time) {
  std::array<double, 3> result{};
  const Value* velocity = collider.find("velocity");
  if (velocity == nullptr) return result;
  for (std::size_t a = 0; a < velocity->items.size() && a < 3; ++a) {
    const Value& item = velocity->items[a];
    result[a] = item.is_number() ? item.number() : Expression(item.text, {"t"})(&time);
  }
  return result;
}

/// Work that the moving colliders do on the particles [J], which the run has summed over its steps.
/// Histories of former versions have the forces on the colliders only, at the rows.
std::vector<double> collider_work(const Run& run, const History& history) {
  const std::vector<double>& time = history.at("time");
  std::vector<double> power(time.size(), 0.0), work(time.size(), 0.0);
  const Value* colliders = run.deck().find("collider");
  if (colliders == nullptr) return work;
  if (sums_collider_work(run, history)) {
    for (const Value& collider : colliders->items) {
      const std::vector<double>& own = history.at(collider.key + "_work");
      for (std::size_t i = 0; i < time.size(); ++i) work[i] += own[i];
    }
    return work;
  }
  for (const Value& collider : colliders->items) {
    for (std::size_t i = 0; i < time.size(); ++i) {
      const auto velocity = velocity_of(collider, time[i]);
      for (std::size_t a = 0; a < 3; ++a) {
        const std::string column = collider.key + "_force_" + axes[a];
        if (velocity[a] != 0 && history.has(column))
          power[i] -= history.at(column)[i] * velocity[a];
      }
    }
  }
  return accumulated(time, power);
}

std::vector<std::string> remarks_of(const Run& run, const History& history) {
  std::vector<std::string> remarks;
  const std::vector<double>& mass = history.at("mass");
  if (mass.back() < mass.front() * (1 - 1e-9)) {
    remarks.push_back(
        fmt::format("{:.4g} % of the mass left the domain; the energy that it took "
                    "along counts as dissipated",
                    100 * (1 - mass.back() / mass.front())));
  }
  const Value* method = run.deck().find("method");
  const bool loads = run.deck().find("traction") != nullptr ||
                     (method != nullptr && method->find("body_force") != nullptr);
  if (loads && !history.has("external_work")) {
    remarks.emplace_back(
        "the run has tractions or body forces, and its history, of a former version, does not "
        "have their work: the dissipated energy is short of it");
  }
  if (!sums_collider_work(run, history)) {
    remarks.emplace_back(
        "the history, of a former version, has the colliders' forces at its rows only: their work "
        "is as good as the rows are dense");
  }
  if (history.has("fluid_mass")) {
    remarks.emplace_back(
        "the elastic energy contains that of the pore water; what water brought along or took "
        "away through drained surfaces counts as dissipated");
  }
  return remarks;
}

Curve curve_of(const Report& report, std::size_t column, const std::string& name, std::size_t i) {
  Curve curve;
  curve.x = report.numbers(0);
  curve.y = report.numbers(column);
  curve.name = name;
  curve.colour = curve_colour(i);
  return curve;
}

Chart chart_of(const Report& report, const Run& run) {
  Chart chart;
  chart.x_label = "Time (s)";
  chart.y_label = run.dimension() == 2 ? "Energy (J/m)" : "Energy (J)";
  chart.curves = {curve_of(report, 3, "work of gravity", 0)};
  if (run.deck().find("collider") != nullptr) {
    chart.curves.push_back(curve_of(report, 4, "work of colliders", 3));
  }
  if (report.columns[5].name == "load_work" && report.rows.back()[5] != Cell(0.0)) {
    chart.curves.push_back(curve_of(report, 5, "work of loads", 5));
  }
  chart.curves.push_back(curve_of(report, 1, "kinetic", 1));
  chart.curves.push_back(curve_of(report, 2, "elastic", 2));
  chart.curves.push_back(curve_of(report, 6, "dissipated", 4));
  return chart;
}

/// The table: what is there, what has been done, and the rest.
Report balance(const Run& run, const History& history) {
  const std::vector<double>& kinetic = history.at("kinetic_energy");
  const std::vector<double>& elastic = history.at("elastic_energy");
  const std::vector<double> gravity = gravity_work(run, history);
  const std::vector<double> colliders = collider_work(run, history);
  const std::vector<double> loads = history.has("external_work")
                                        ? history.at("external_work")
                                        : std::vector<double>(kinetic.size(), 0.0);
  Report report;
  report.command = "energy";
  const std::string unit = run.dimension() == 2 ? "J/m" : "J";
  report.columns = {{"time", "s"}};
  for (const char* name :
       {"kinetic", "elastic", "gravity_work", "collider_work", "load_work", "dissipated"}) {
    report.columns.push_back({name, unit});
  }
  double largest = 0;
  for (std::size_t i = 0; i < kinetic.size(); ++i) {
    const double stored = kinetic[i] - kinetic[0] + elastic[i] - elastic[0];
    const double work = gravity[i] + colliders[i] + loads[i];
    report.add({history.at("time")[i], kinetic[i], elastic[i], gravity[i], colliders[i], loads[i],
                work - stored});
    largest = std::max(largest, kinetic[i]);
  }
  const auto& last = report.rows.back();
  report.facts = {{"end", last[0], "s"},
                  {"work", gravity.back() + colliders.back() + loads.back(), unit},
                  {"gravity_work", last[3], unit},
                  {"collider_work", last[4], unit},
                  {"load_work", last[5], unit},
                  {"kinetic", last[1], unit},
                  {"elastic", last[2], unit},
                  {"dissipated", last[6], unit},
                  {"largest_kinetic", largest, unit}};
  return report;
}

int run_energy(const EnergyOptions& options) {
  const Run run(options.run);
  check_targets(options.output, run);
  const History history = read_history(run.folder());
  for (const char* column : {"time", "mass", "center_x", "kinetic_energy", "elastic_energy"}) {
    if (!history.has(column)) {
      throw UserError((run.folder() / "history.csv").string() + " has no column " + column);
    }
  }
  Report report = balance(run, history);
  report.run = options.run;
  report.remarks = remarks_of(run, history);
  deliver(report, {chart_of(report, run)}, run.title(),
          "Work done on the particles, and where it went", options.output);
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<EnergyOptions>();
  set.positional("run", shared->run, "RUN", "Run folder");
  add_output_options(set, shared->output);
  set.footer(
      "Dissipated is the work of gravity, of moving colliders and of loads (tractions, body\n"
      "forces) less the change of kinetic and elastic energy: plasticity, viscosity, friction, "
      "damping and the method's own losses.");
  return [shared](const PostWords&) { return run_energy(*shared); };
}

}  // namespace

PostCommand post_energy() {
  return {"energy", "Balance of work, kinetic, elastic and dissipated energy", false, &declare};
}

}  // namespace scree
