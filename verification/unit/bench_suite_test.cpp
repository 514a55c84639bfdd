// SPDX-License-Identifier: Apache-2.0
// `scree bench --suite`: shape and consistency of what it prints; no timings.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/bench_case.hpp"
#include "app/bench_suite.hpp"
#include "app/bench_suite_text.hpp"
#include "solver/simulation/simulation.hpp"
#include "verification/unit/run_scree.hpp"

namespace scree {
namespace {

using Json = nlohmann::json;

// Numbers are printed with all digits: quotients differ by their own rounding.
constexpr double rounding = 1e-12;

/// The quick suite with one and two threads, run once for all tests.
const Json& suite() {
  static const Json json = [] {
    std::string out;
    EXPECT_EQ(run_scree({"bench", "--suite", "--quick", "--threads", "2", "--json"}, out), 0);
    return Json::parse(out);
  }();
  return json;
}

void check_best_first(const Json& pair, bool less_is_better) {
  const double best = pair.at("best");
  const double median = pair.at("median");
  EXPECT_GT(best, 0);
  EXPECT_GT(median, 0);
  EXPECT_TRUE(less_is_better ? best <= median : best >= median) << pair;
}

/// Rate x threads x ns = 1e9, for the best and the median.
void check_cost(const Json& cost, int threads) {
  const Json& ns = cost.at("ns_per_particle");
  const Json& rate = cost.at("updates_per_second_per_thread");
  check_best_first(ns, true);
  check_best_first(rate, false);
  for (const char* which : {"best", "median"}) {
    const double product = ns.at(which).get<double>() * rate.at(which).get<double>() * threads;
    EXPECT_NEAR(product, 1e9, 1e9 * rounding) << cost;
  }
  EXPECT_GT(cost.at("particles").get<int>(), 0);
  EXPECT_GT(cost.at("steps").get<int>(), 0);
  EXPECT_GT(cost.at("bytes_per_particle").get<double>(), 0);
  EXPECT_GE(cost.at("busy").get<double>(), 0);
}

double bandwidth_of(int threads) {
  for (const Json& row : suite().at("bandwidth")) {
    if (row.at("threads") == threads) return row.at("update_bytes_per_second").at("best");
  }
  ADD_FAILURE() << "no bandwidth of " << threads << " threads";
  return 1;
}

TEST(BenchSuite, TableHasEveryCombinationOnce) {
  std::set<std::string> seen;
  for (const Json& row : suite().at("table")) {
    const int threads = row.at("threads");
    seen.insert(row.at("case").get<std::string>() + row.at("precision").get<std::string>() +
                std::to_string(threads) + "in" + std::to_string(row.at("dimension").get<int>()));
    for (const char* kernel : {"compact", "quadratic"}) check_cost(row.at(kernel), threads);
  }
  EXPECT_EQ(seen.size(), 3u * 2u * 2u * 2u);  // cases, dimensions, precisions, threads
  EXPECT_EQ(suite().at("table").size(), seen.size());
}

TEST(BenchSuite, KernelRatioIsTheQuotientOfTheRates) {
  for (const Json& row : suite().at("table")) {
    const auto rate = [&](const char* kernel) -> double {
      return row.at(kernel).at("updates_per_second_per_thread").at("best");
    };
    const double quotient = rate("compact") / rate("quadratic");
    EXPECT_NEAR(row.at("compact_to_quadratic").get<double>(), quotient, quotient * rounding);
  }
}

TEST(BenchSuite, BandwidthShareIsTrafficTimesRate) {
  for (const Json& row : suite().at("table")) {
    const int threads = row.at("threads");
    for (const char* kernel : {"compact", "quadratic"}) {
      const Json& cost = row.at(kernel);
      const double traffic = cost.at("particle_traffic_per_particle").get<double>() +
                             cost.at("grid_traffic_per_particle").get<double>();
      const double ns = cost.at("ns_per_particle").at("best");
      const double share = 1e9 * traffic / ns / bandwidth_of(threads);
      EXPECT_NEAR(cost.at("bandwidth_share").get<double>(), share, share * rounding);
    }
  }
}

TEST(BenchSuite, SweepHasEverySizeAndItsSpread) {
  const Json& sweep = suite().at("sweep");
  EXPECT_EQ(sweep.at("points").size() + sweep.at("left_out").size(),
            2u * 2u * 2u);  // sizes, precisions, numbers of threads
  for (const Json& point : sweep.at("points")) {
    check_cost(point, point.at("threads"));
    EXPECT_GT(point.at("set_up_seconds").get<double>(), 0);
  }
  double worst = 0;
  for (const Json& series : sweep.at("spreads")) {
    double least = 1e300;
    double most = 0;
    for (const Json& point : sweep.at("points")) {
      if (point.at("precision") != series.at("precision")) continue;
      if (point.at("threads") != series.at("threads")) continue;
      least = std::min(least, point.at("ns_per_particle").at("best").get<double>());
      most = std::max(most, point.at("ns_per_particle").at("best").get<double>());
    }
    EXPECT_NEAR(series.at("spread").get<double>(), most / least - 1, most / least * rounding);
    worst = std::max(worst, series.at("spread").get<double>());
  }
  EXPECT_EQ(sweep.at("flat").get<bool>(), worst <= sweep.at("allowed_spread").get<double>());
}

TEST(BenchSuite, NamesTheMachineAndItsMemory) {
  for (const char* key : {"cpu", "instruction_set", "compiler"}) {
    EXPECT_FALSE(suite().at("machine").at(key).get<std::string>().empty()) << key;
  }
  EXPECT_GE(suite().at("machine").at("hardware_threads").get<int>(), 1);
  EXPECT_TRUE(suite().at("quick").get<bool>());
  ASSERT_EQ(suite().at("bandwidth").size(), 2u);
  for (const Json& row : suite().at("bandwidth")) {
    check_best_first(row.at("copy_bytes_per_second"), false);
    check_best_first(row.at("update_bytes_per_second"), false);
  }
}

TEST(BenchSuite, PrintsText) {
  std::string text;
  ASSERT_EQ(run_scree({"bench", "--suite", "--quick", "--threads", "1"}, text), 0);
  for (const char* part : {"machine: ", "\nMemory", "\nParticle updates", "\nSizes",
                           "\nverdict: ", "\nelastic ", "\nsand ", "\nfluid "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(BenchSuite, ExcludesTheOptionsOfOneCase) {
  std::string out;
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_scree({"bench", "--suite", "--case", "sand"}, out), 2);
  EXPECT_EQ(run_scree({"bench", "--quick"}, out), 2);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_NE(errors.find("--case"), std::string::npos) << errors;
  EXPECT_NE(errors.find("--suite"), std::string::npos) << errors;
}

TEST(BenchSuite, WholeSuiteHasTheSizesOfTheSweep) {
  BenchOptions options;
  options.threads = 3;
  const SuitePlan plan = suite_plan(options, machine_info());
  EXPECT_EQ(plan.table.threads, (std::vector<int>{1, 3}));
  EXPECT_EQ(plan.table.particles, 1'000'000);
  EXPECT_EQ(plan.sweep.particles,
            (std::vector<std::int64_t>{10'000, 100'000, 1'000'000, 10'000'000}));
}

SweepPoint sweep_point(std::int64_t particles, double ns) {
  SweepPoint point;
  point.precision = "single";
  point.cost.particles = particles;
  point.cost.ns_per_particle = {ns, ns};
  return point;
}

TEST(BenchSuite, VerdictLooksAtTheSizesFromTheBoundOn) {
  SweepPlan plan;
  plan.threads = {1};
  Sweep sweep;
  sweep.points = {sweep_point(10'000, 50), sweep_point(97'336, 20)};
  EXPECT_TRUE(sweep_spreads(plan, sweep.points).empty());  // one size is no series
  EXPECT_NE(verdict_text(plan, sweep).find("none"), std::string::npos);
  sweep.points.push_back(sweep_point(1'000'000, 22));
  const auto spreads = sweep_spreads(plan, sweep.points);
  ASSERT_EQ(spreads.size(), 1u);
  EXPECT_NEAR(spreads[0].spread, 22.0 / 20 - 1, rounding);
  EXPECT_NE(verdict_text(plan, sweep).find("within"), std::string::npos);
  sweep.points.push_back(sweep_point(10'000'000, 24));
  EXPECT_NE(verdict_text(plan, sweep).find("beyond"), std::string::npos);
}

TEST(BenchSuite, LeavesOutWhatDoesNotFitIntoMemory) {
  SweepPlan plan;
  plan.particles = {64, 4'000'000'000'000};  // 1 PB
  plan.threads = {1};
  plan.repeats = {1, 1, 0.0};
  const Sweep sweep = measure_sweep(plan, [](const SweepPoint&) {});
  ASSERT_EQ(sweep.points.size(), 2u);  // the small size in both precisions
  ASSERT_EQ(sweep.left_out.size(), 2u);
  for (const LeftOut& left : sweep.left_out) {
    EXPECT_EQ(left.particles, 4'000'000'000'000);
    EXPECT_GT(left.needed_bytes, left.free_bytes);
    EXPECT_NE(left_out_text(left).find("4000000000000 particles"), std::string::npos);
  }
}

TEST(BenchSuite, BestIsTheLeastAndTheMedianLiesInTheMiddle) {
  EXPECT_EQ(best_and_median({3, 1, 2}).best, 1);
  EXPECT_EQ(best_and_median({3, 1, 2}).median, 2);
  EXPECT_EQ(best_and_median({4, 1, 3, 2}).median, 2.5);
}

TEST(BenchSuite, BusyIsTheShareOfTheThreadsTime) {
  const StepTime time{2.0, 3.0};
  EXPECT_EQ(time.busy(1), 1.5);
  EXPECT_EQ(time.busy(3), 0.5);
}

TEST(BenchSuite, CasesOfTwoDimensionsLieInAPlane) {
  for (const char* name : {"elastic", "sand", "fluid"}) {
    BenchOptions options;
    options.case_name = name;
    options.dimension = 2;
    options.particles = 4000;
    const SimulationSetup setup = build_bench_case(options);
    EXPECT_EQ(setup.dimension, 2);
    const auto count = double(setup.bodies[0].position.size() / 3);
    EXPECT_NEAR(count, 4000, 400)
        << name;  // whole cells of 4: about 32 an axis, half of one missing
    double area = 0;
    for (std::size_t p = 2; p < setup.bodies[0].position.size(); p += 3) {
      EXPECT_EQ(setup.bodies[0].position[p], 0);
      area += setup.bodies[0].particle_volume;
    }
    EXPECT_NEAR(area, count / 4 * setup.cell_size * setup.cell_size, 1e-9) << name;
    const auto simulation = Simulation::create(build_bench_case(options));
    simulation->step();
    EXPECT_TRUE(simulation->fused());
  }
}

/// One full block of single precision: the count can be written down.
TEST(BenchSuite, TrafficOfOneBlock) {
  BenchOptions options;
  options.particles = 8;  // of one cell: one batch of one block
  options.precision = "single";
  const auto simulation = Simulation::create(build_bench_case(options));
  // Position and F, 12 numbers of 16 lanes, read and written.
  EXPECT_EQ(simulation->traffic().particles, 2 * 12 * 16 * 4);
  // Arena: 2 x 6^3 nodes, 3 accesses; grid: 2 x 4^3 nodes a block, 5 accesses; 4 floats a node.
  const std::int64_t arena = 2 * 6 * 6 * 6 * 3;
  const std::int64_t grid = simulation->block_count() * 2 * 4 * 4 * 4 * 5;
  EXPECT_EQ(simulation->traffic().grid, (arena + grid) * 4 * 4);
  options.path = "split";
  EXPECT_EQ(Simulation::create(build_bench_case(options))->traffic().total(), 0);
}

}  // namespace
}  // namespace scree
