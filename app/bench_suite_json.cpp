// SPDX-License-Identifier: Apache-2.0
#include "app/bench_suite_json.hpp"

#include <nlohmann/json.hpp>

namespace scree {
namespace {

using Json = nlohmann::ordered_json;

/// A number, or null for none.
template <class T>
Json maybe(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json pair_json(const BestMedian& value) { return {{"best", value.best}, {"median", value.median}}; }

Json machine_json(const MachineInfo& machine) {
  return {{"cpu", machine.cpu},
          {"hardware_threads", machine.threads},
          {"instruction_set", machine.instruction_set},
          {"compiler", machine.compiler},
          {"cache_bytes", machine.cache_bytes}};
}

Json bandwidth_json(const Bandwidth& bandwidth) {
  return {{"threads", bandwidth.threads},
          {"array_bytes", bandwidth.array_bytes},
          {"copy_bytes_per_second", pair_json(bandwidth.copy)},
          {"update_bytes_per_second", pair_json(bandwidth.update)}};
}

Json cost_json(const StepCost& cost) {
  return {{"particles", cost.particles},
          {"steps", cost.steps},
          {"ns_per_particle", pair_json(cost.ns_per_particle)},
          {"updates_per_second_per_thread", pair_json(cost.rate_per_thread())},
          {"busy", cost.busy},
          {"bytes_per_particle", cost.bytes_per_particle}};
}

Json kernel_json(const StepCost& cost, const std::vector<Bandwidth>& bandwidth) {
  Json out = cost_json(cost);
  const double particles = double(cost.particles);
  out["particle_traffic_per_particle"] = double(cost.traffic.particles) / particles;
  out["grid_traffic_per_particle"] = double(cost.traffic.grid) / particles;
  out["bandwidth_share"] = maybe(bandwidth_share(cost, bandwidth));
  return out;
}

Json row_json(const TableRow& row, const std::vector<Bandwidth>& bandwidth) {
  return {{"case", row.case_name},
          {"dimension", row.dimension},
          {"precision", row.precision},
          {"threads", row.threads},
          {"compact", kernel_json(row.compact, bandwidth)},
          {"quadratic", kernel_json(row.quadratic, bandwidth)},
          {"compact_to_quadratic", row.compact_to_quadratic()}};
}

Json point_json(const SweepPoint& point) {
  Json out{{"precision", point.precision}, {"threads", point.cost.threads}};
  out.update(cost_json(point.cost));
  out["set_up_seconds"] = point.set_up_seconds;
  out["peak_growth_bytes"] = maybe(point.peak_growth);
  return out;
}

Json left_out_json(const LeftOut& left) {
  return {{"precision", left.precision},
          {"threads", left.threads},
          {"particles", left.particles},
          {"needed_bytes", left.needed_bytes},
          {"free_bytes", left.free_bytes}};
}

Json sweep_json(const SweepPlan& plan, const Sweep& sweep) {
  Json points = Json::array();
  for (const SweepPoint& point : sweep.points) points.push_back(point_json(point));
  Json left_out = Json::array();
  for (const LeftOut& left : sweep.left_out) left_out.push_back(left_out_json(left));
  Json spreads = Json::array();
  const std::vector<SweepSpread> found = sweep_spreads(plan, sweep.points);
  for (const SweepSpread& series : found) {
    spreads.push_back(
        {{"precision", series.precision}, {"threads", series.threads}, {"spread", series.spread}});
  }
  const SweepSpread* worst = worst_spread(found);
  return {{"case", "elastic"},
          {"kernel", "compact"},
          {"points", points},
          {"left_out", left_out},
          {"flat_from", plan.flat_from},
          {"allowed_spread", plan.allowed_spread},
          {"spreads", spreads},
          {"flat", worst == nullptr ? Json(nullptr) : Json(worst->spread <= plan.allowed_spread)}};
}

}  // namespace

std::string suite_json(const SuitePlan& plan, const SuiteResult& result) {
  Json bandwidth = Json::array();
  for (const Bandwidth& memory : result.bandwidth) bandwidth.push_back(bandwidth_json(memory));
  Json table = Json::array();
  for (const TableRow& row : result.table) table.push_back(row_json(row, result.bandwidth));
  const Json out{{"machine", machine_json(result.machine)},
                 {"quick", plan.quick},
                 {"repeats", plan.table.repeats.repeats},
                 {"bandwidth", bandwidth},
                 {"table", table},
                 {"sweep", sweep_json(plan.sweep, result.sweep)}};
  return out.dump(2) + "\n";
}

}  // namespace scree
