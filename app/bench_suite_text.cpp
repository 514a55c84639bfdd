// SPDX-License-Identifier: Apache-2.0
#include "app/bench_suite_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scree {
namespace {

std::string threads_text(int threads) {
  return fmt::format("{} thread{}", threads, threads == 1 ? "" : "s");
}

/// best (median), in units of `unit`.
std::string pair_text(const BestMedian& value, double unit) {
  return fmt::format("{:.2f} ({:.2f})", value.best / unit, value.median / unit);
}

}  // namespace

std::string machine_text(const MachineInfo& machine) {
  return fmt::format("machine: {}, {}, last cache {:.0f} MB; program: {}, {}\n", machine.cpu,
                     threads_text(machine.threads), double(machine.cache_bytes) / 1e6,
                     machine.instruction_set, machine.compiler);
}

std::string bandwidth_head(const SuitePlan& plan) {
  return fmt::format(
      "\nMemory, GB/s read and written, best (median) of {}; arrays of {:.0f} MB\n"
      "{:>7}  {:>20}  {:>20}\n",
      plan.bandwidth_repeats, double(plan.array_bytes) / 1e6, "threads", "copy b = s a",
      "update a = s a");
}

std::string bandwidth_text(const Bandwidth& bandwidth) {
  return fmt::format("{:>7}  {:>20}  {:>20}\n", bandwidth.threads, pair_text(bandwidth.copy, 1e9),
                     pair_text(bandwidth.update, 1e9));
}

std::string table_head(const TablePlan& plan) {
  return fmt::format(
      "\nParticle updates, million/s a thread, best (median) of {}; {} particles\n"
      "{:<11} {:<9} {:>7}  {:>15}  {:>15}  {:>6}  {:>9}  {:>21}\n",
      plan.repeats.repeats, plan.particles, "case", "precision", "threads", "compact", "quadratic",
      "c : q", "busy", "compact's memory rate");
}

std::string table_text(const TableRow& row, const std::optional<double>& share) {
  const std::string used =
      share ? fmt::format("{:.0f} B, {:.0f} %", row.compact.traffic_per_particle(), 100 * *share)
            : "unknown";
  const double busy = std::min(row.compact.busy, row.quadratic.busy);
  return fmt::format("{:<7} {}D  {:<9} {:>7}  {:>15}  {:>15}  {:>6.2f}  {:>7.0f} %  {:>21}\n",
                     row.case_name, row.dimension, row.precision, row.threads,
                     pair_text(row.compact.rate_per_thread(), 1e6),
                     pair_text(row.quadratic.rate_per_thread(), 1e6), row.compact_to_quadratic(),
                     100 * busy, used);
}

std::string sweep_head(const SweepPlan& plan) {
  return fmt::format(
      "\nSizes: elastic, compact; ns a particle, best (median) of {}\n"
      "{:<9} {:>7} {:>10}  {:>17}  {:>6}  {:>8}  {:>16}  {:>20}\n",
      plan.repeats.repeats, "precision", "threads", "particles", "ns a particle", "busy",
      "set-up s", "bytes a particle", "peak growth/particle");
}

std::string sweep_text(const SweepPoint& point) {
  const double particles = double(point.cost.particles);
  const std::string growth = point.peak_growth
                                 ? fmt::format("{:.0f}", double(*point.peak_growth) / particles)
                                 : "not told";
  return fmt::format("{:<9} {:>7} {:>10}  {:>17}  {:>4.0f} %  {:>8.2f}  {:>16.1f}  {:>20}\n",
                     point.precision, point.cost.threads, point.cost.particles,
                     pair_text(point.cost.ns_per_particle, 1), 100 * point.cost.busy,
                     point.set_up_seconds, point.cost.bytes_per_particle, growth);
}

std::string left_out_text(const LeftOut& left) {
  return fmt::format(
      "left out: {} particles, {}, {}: about {:.1f} GB to set up, {:.1f} GB of memory are free\n",
      left.particles, left.precision, threads_text(left.threads), double(left.needed_bytes) / 1e9,
      double(left.free_bytes) / 1e9);
}

std::string verdict_text(const SweepPlan& plan, const Sweep& sweep) {
  const std::vector<SweepSpread> spreads = sweep_spreads(plan, sweep.points);
  const SweepSpread* worst = worst_spread(spreads);
  if (worst == nullptr) {
    return fmt::format("verdict: none; two sizes from {} particles on are needed\n",
                       plan.flat_from);
  }
  return fmt::format(
      "verdict: from {} particles on the cost of a particle varies by at most {:.1f} % ({}, {}): "
      "{} the {:.0f} % allowed\n",
      plan.flat_from, 100 * worst->spread, worst->precision, threads_text(worst->threads),
      worst->spread <= plan.allowed_spread ? "within" : "beyond", 100 * plan.allowed_spread);
}

}  // namespace scree
