// SPDX-License-Identifier: Apache-2.0
#include "app/bench_sweep.hpp"

#include <algorithm>

#include "app/memory_info.hpp"

namespace scree {
namespace {

SweepPoint measure_point(const BenchOptions& options, const RepeatPlan& repeats) {
  SweepPoint point;
  point.precision = options.precision;
  const bool fresh_peak = reset_peak_memory();
  const std::int64_t before = resident_memory();
  BenchRun run(options);
  point.set_up_seconds = run.set_up_seconds();
  point.cost = measure_by_turns({&run}, repeats)[0];
  if (fresh_peak) point.peak_growth = std::max<std::int64_t>(0, peak_memory() - before);
  return point;
}

/// Whether a point belongs to a series and to the sizes whose cost must be the same.
bool in_series(const SweepPlan& plan, const SweepPoint& point, const SweepSpread& series) {
  // Bodies are whole cells: a size of 1e5 becomes 97 336 particles.
  const double from = 0.9 * double(plan.flat_from);
  return point.precision == series.precision && point.cost.threads == series.threads &&
         double(point.cost.particles) >= from;
}

}  // namespace

std::int64_t sweep_memory(std::int64_t particles, const std::string& precision) {
  // Bytes a particle at the peak of set-up: 200 and 320 measured at 1e6 particles, and a quarter.
  return particles * (precision == "single" ? 250 : 400);
}

Sweep measure_sweep(const SweepPlan& plan, const SweepReport& report) {
  Sweep sweep;
  for (const char* precision : {"single", "double"}) {
    for (const int threads : plan.threads) {
      for (const std::int64_t particles : plan.particles) {
        const std::int64_t needed = sweep_memory(particles, precision);
        const auto free = free_memory();
        if (free && needed > *free) {
          sweep.left_out.push_back({precision, threads, particles, needed, *free});
          continue;
        }
        BenchOptions options;
        options.particles = particles;
        options.precision = precision;
        options.threads = threads;
        options.backend = plan.backend;
        sweep.points.push_back(measure_point(options, plan.repeats));
        report(sweep.points.back());
      }
    }
  }
  return sweep;
}

std::vector<SweepSpread> sweep_spreads(const SweepPlan& plan,
                                       const std::vector<SweepPoint>& points) {
  std::vector<SweepSpread> spreads;
  for (const char* precision : {"single", "double"}) {
    for (const int threads : plan.threads) {
      SweepSpread series{precision, threads, 0};
      std::vector<double> ns;
      for (const SweepPoint& point : points) {
        if (in_series(plan, point, series)) ns.push_back(point.cost.ns_per_particle.best);
      }
      if (ns.size() < 2) continue;
      const auto [least, most] = std::minmax_element(ns.begin(), ns.end());
      series.spread = *most / *least - 1;
      spreads.push_back(series);
    }
  }
  return spreads;
}

const SweepSpread* worst_spread(const std::vector<SweepSpread>& spreads) {
  const auto worst = std::max_element(
      spreads.begin(), spreads.end(),
      [](const SweepSpread& a, const SweepSpread& b) { return a.spread < b.spread; });
  return worst == spreads.end() ? nullptr : &*worst;
}

}  // namespace scree
