// SPDX-License-Identifier: Apache-2.0
/// \file
/// The micro-benchmarks by group. Names are paths (what/kernel/dimension/real), so that
/// --benchmark_filter can choose.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree::benchmarks {

void add_transfers();
void add_staging();
void add_elastic_blocks();
void add_sand_blocks();
void add_materials();
void add_algebra();

template <class T>
inline constexpr const char* real_name = sizeof(T) == 4 ? "float" : "double";

/// f(benchmark::State&); repetitions also print their smallest time, the one to compare: other
/// programs on the machine only ever add to it.
template <class F>
void add(const std::string& name, F f) {
  benchmark::RegisterBenchmark(name.c_str(), f)
      ->ComputeStatistics("min", [](const std::vector<double>& values) {
        return *std::min_element(values.begin(), values.end());
      });
}

/// Reports items_per_second and time/<item> [s], for loops that do `items` of them each time.
inline void count(benchmark::State& state, int items, const std::string& item) {
  using benchmark::Counter;
  state.SetItemsProcessed(state.iterations() * items);
  state.counters["time/" + item] =
      Counter(items, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

/// f.template operator()<Kernel, D, T>() for both kernels with affine transfers, both dimensions
/// and precisions.
template <class F>
void for_every_kind(F f) {
  const auto both_kernels = [&]<int D, class T> {
    f.template operator()<Compact, D, T>();
    f.template operator()<Quadratic, D, T>();
  };
  both_kernels.template operator()<2, float>();
  both_kernels.template operator()<2, double>();
  both_kernels.template operator()<3, float>();
  both_kernels.template operator()<3, double>();
}

/// "/compact/3d/float"
template <class Kernel, int D, class T>
std::string kind_name() {
  return std::string("/") + Kernel::name + "/" + std::to_string(D) + "d/" + real_name<T>;
}

}  // namespace scree::benchmarks
