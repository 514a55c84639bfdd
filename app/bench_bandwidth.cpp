// SPDX-License-Identifier: Apache-2.0
#include "app/bench_bandwidth.hpp"

#include <algorithm>
#include <chrono>
#include <functional>

#include "solver/exec/aligned.hpp"
#include "solver/exec/thread_pool.hpp"

namespace scree {
namespace {

using Array = AlignedVector<double>;
/// Works on the elements [first, last) of the arrays.
using Loop = std::function<void(std::int64_t first, std::int64_t last)>;

void copy_scaled(const double* from, double* to, double factor, std::int64_t first,
                 std::int64_t last) {
  for (std::int64_t i = first; i < last; ++i) to[i] = factor * from[i];
}

void scale(double* values, double factor, std::int64_t first, std::int64_t last) {
  for (std::int64_t i = first; i < last; ++i) values[i] *= factor;
}

/// Bytes per second of `loop` over n elements, of which each is read and written once.
BestMedian rate(ThreadPool& pool, std::int64_t n, int repeats, const Loop& loop) {
  const std::int64_t parts = pool.size();
  std::vector<double> seconds;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    pool.for_each(parts, [&](std::int64_t i, int) { loop(n * i / parts, n * (i + 1) / parts); });
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    seconds.push_back(spent.count());
  }
  const BestMedian time = best_and_median(seconds);
  const double bytes = 2.0 * sizeof(double) * double(n);
  return {bytes / time.best, bytes / time.median};
}

}  // namespace

Bandwidth measure_bandwidth(int threads, std::int64_t array_bytes, int repeats) {
  const std::int64_t n = std::max<std::int64_t>(1, array_bytes / std::int64_t(sizeof(double)));
  Array a(std::size_t(n), 1.0);
  Array b(std::size_t(n), 0.0);
  // Near one, so that repeats neither overflow nor end below the normal range.
  const double factor = 1 + 1e-9;
  ThreadPool pool(threads);
  Bandwidth result;
  result.threads = threads;
  result.array_bytes = n * std::int64_t(sizeof(double));
  result.copy = rate(pool, n, repeats, [&](std::int64_t first, std::int64_t last) {
    copy_scaled(a.data(), b.data(), factor, first, last);
  });
  result.update = rate(pool, n, repeats, [&](std::int64_t first, std::int64_t last) {
    scale(a.data(), factor, first, last);
  });
  return result;
}

std::int64_t bandwidth_array_bytes(std::int64_t cache_bytes, std::int64_t free_bytes) {
  constexpr std::int64_t least = std::int64_t(256) << 20;
  return std::min(std::max(least, 4 * cache_bytes), free_bytes / 4);
}

}  // namespace scree
