// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solver/exec/aligned.hpp"
#include "solver/exec/block_group.hpp"
#include "solver/exec/flush_subnormals.hpp"
#include "solver/exec/thread_pool.hpp"

namespace scree {

/// The CPU executor: a team of threads, each with its own arena memory.
class Executor {
 public:
  explicit Executor(int threads) : pool_(threads), arenas_(std::size_t(pool_.size())) {}

  ThreadPool& pool() { return pool_; }
  int threads() const { return pool_.size(); }

  /// This thread's arena with room for n values.
  template <class T>
  T* arena(int thread, std::size_t n) {
    AlignedVector<unsigned char>& memory = arenas_[std::size_t(thread)];
    if (memory.size() < n * sizeof(T)) memory.resize(n * sizeof(T));
    return reinterpret_cast<T*>(memory.data());
  }

  std::int64_t bytes() const {
    std::int64_t total = 0;
    for (const auto& arena : arenas_) total += std::int64_t(arena.capacity());
    return total;
  }

 private:
  ThreadPool pool_;
  std::vector<AlignedVector<unsigned char>> arenas_;
};

/// Runs a body on every listed block: f(group).
template <class Kernel, int D, class T, class F>
void for_each_block(Executor& executor, const PassData<D, T>& data,
                    const std::vector<std::int32_t>& blocks, F&& f) {
  using Group = BlockGroup<D, T, Kernel>;
  const auto run = [&](std::int64_t i, int thread) {
    const FlushSubnormals flush;
    Group group(data, executor.arena<T>(thread, Group::arena_values));
    group.begin(blocks[std::size_t(i)]);
    if (std::size_t(i) + 1 < blocks.size()) group.expect(blocks[std::size_t(i) + 1]);
    f(group);
    group.finish();
  };
  // Blocks one after the other for the same thread, so that it can look ahead; few enough that the
  // threads end together.
  const std::int64_t count = std::int64_t(blocks.size());
  executor.pool().for_each(count, run,
                           std::clamp<std::int64_t>(count / (16 * executor.threads()), 1, 4));
}

}  // namespace scree
