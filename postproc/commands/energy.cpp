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

/// Work that the moving colliders do on the particles [J]: the history holds the forces on the
/// colliders, which are the opposite ones.
std::vector<double> collider_work(const Run& run, const History& history) {
  const std::vector<double>& time = history.at("time");
  std::vector<double> power(time.size(), 0.0);
  const Value* colliders = run.deck().find("collider");
  if (colliders == nullptr) return power;
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
  if (run.deck().find("traction") != nullptr) {
    remarks.push_back(
        "the run has tractions, whose work is not in the history: the dissipated "
        "energy is short of it");
  }
  const Value* method = run.deck().find("method");
  if (method != nullptr && method->find("body_force") != nullptr) {
    remarks.push_back(
        "the run has body forces, whose work is not in the history: the dissipated "
        "energy is short of it");
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
  chart.curves.push_back(curve_of(report, 1, "kinetic", 1));
  chart.curves.push_back(curve_of(report, 2, "elastic", 2));
  chart.curves.push_back(curve_of(report, 5, "dissipated", 4));
  return chart;
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
  const std::vector<double>& kinetic = history.at("kinetic_energy");
  const std::vector<double>& elastic = history.at("elastic_energy");
  const std::vector<double> gravity = gravity_work(run, history);
  const std::vector<double> colliders = collider_work(run, history);
  Report report;
  report.command = "energy";
  report.run = options.run;
  report.columns = {{"time", "s"},         {"kinetic", "J"},       {"elastic", "J"},
                    {"gravity_work", "J"}, {"collider_work", "J"}, {"dissipated", "J"}};
  double largest = 0;
  for (std::size_t i = 0; i < kinetic.size(); ++i) {
    const double stored = kinetic[i] - kinetic[0] + elastic[i] - elastic[0];
    report.add({history.at("time")[i], kinetic[i], elastic[i], gravity[i], colliders[i],
                gravity[i] + colliders[i] - stored});
    largest = std::max(largest, kinetic[i]);
  }
  const auto& last = report.rows.back();
  report.facts = {{"end", last[0], "s"},          {"work", gravity.back() + colliders.back(), "J"},
                  {"gravity_work", last[3], "J"}, {"collider_work", last[4], "J"},
                  {"kinetic", last[1], "J"},      {"elastic", last[2], "J"},
                  {"dissipated", last[5], "J"},   {"largest_kinetic", largest, "J"}};
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
      "Dissipated is the work of gravity and of moving colliders less the change of kinetic and\n"
      "elastic energy: plasticity, viscosity, friction, damping and the method's own losses.");
  return [shared](const PostWords&) { return run_energy(*shared); };
}

}  // namespace

PostCommand post_energy() {
  return {"energy", "Balance of work, kinetic, elastic and dissipated energy", false, &declare};
}

}  // namespace scree
