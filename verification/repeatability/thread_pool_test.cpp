// SPDX-License-Identifier: Apache-2.0
//
// Every index of a range is run once, whatever the number of threads and the length of the range.
#include "solver/exec/thread_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace scree {
namespace {

TEST(ThreadPool, runs_every_index_once) {
  for (int threads : {1, 2, 3, 7}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.size(), threads);
    for (std::int64_t count : {0, 1, 2, 5, 6, 7, 64, 1001})
      for (std::int64_t chunk : {1, 3, 200}) {
        std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
        std::atomic<bool> known_thread = true;
        pool.for_each(
            count,
            [&](std::int64_t i, int thread) {
              ++runs[static_cast<std::size_t>(i)];
              if (thread < 0 || thread >= threads) known_thread = false;
            },
            chunk);
        EXPECT_TRUE(known_thread);
        for (const std::atomic<int>& n : runs) ASSERT_EQ(n, 1) << threads << ' ' << count;
      }
  }
}

/// A thread that is slow leaves the rest of its part to the others: no index waits for it.
TEST(ThreadPool, part_of_a_slow_thread_is_done_by_others) {
  ThreadPool pool(2);
  std::atomic<int> done = 0;
  pool.for_each(100, [&](std::int64_t i, int) {
    // The first index, of the first part, waits until all others are done.
    while (i == 0 && done < 99) std::this_thread::yield();
    ++done;
  });
  EXPECT_EQ(done, 100);
}

TEST(ThreadPool, hands_on_the_first_exception_and_goes_on) {
  ThreadPool pool(3);
  const auto fail = [](std::int64_t i, int) {
    if (i == 70) throw std::runtime_error("index " + std::to_string(i));
  };
  EXPECT_THROW(pool.for_each(100, fail), std::runtime_error);
  std::atomic<int> runs = 0;
  pool.for_each(100, [&](std::int64_t, int) { ++runs; });
  EXPECT_EQ(runs, 100);
}

}  // namespace
}  // namespace scree
