// SPDX-License-Identifier: Apache-2.0
//
// Copies between grid and arena for one block whose grid values are in the cache: what remains of
// the cost a block when nothing waits for memory.
#include "solver/exec/cpu_group.hpp"
#include "verification/benchmark/benchmarks.hpp"
#include "verification/support/block_scene.hpp"

namespace scree::benchmarks {
namespace {

template <class Kernel, int D, class T>
class Load {
 public:
  using Group = CpuGroup<D, T, Kernel>;

  Load() : arena_(Group::arena_values), group_(data_, arena_.data()) {
    testing::Random random(5);
    for (T& x : arena_) x = T(random.uniform(-1, 1));
    group_.begin(0);
    benchmark::DoNotOptimize(arena_.data());
  }

  Group& group() { return group_; }

 private:
  testing::BlockScene<D, T> scene_{Kernel::lattices, {1}, 3};
  PassData<D, T> data_ = scene_.data();
  AlignedVector<T> arena_;
  Group group_;
};

/// f(group) for each block.
template <class Kernel, int D, class T, class F>
void add_copy(const std::string& name, F f) {
  add(name + kind_name<Kernel, D, T>(), [f](benchmark::State& state) {
    Load<Kernel, D, T> load;
    for (auto _ : state) {
      f(load.group());
      benchmark::ClobberMemory();
    }
    count(state, 1, "block");
  });
}

template <class Kernel, int D, class T>
void add_kernel() {
  add_copy<Kernel, D, T>("stage_in", [](auto& group) { group.stage_in(0); });
  add_copy<Kernel, D, T>("stage_out", [](auto& group) { group.stage_out(0); });
  add_copy<Kernel, D, T>("clear", [](auto& group) { group.clear(0); });
}

}  // namespace

void add_staging() {
  for_every_kind([]<class Kernel, int D, class T> { add_kernel<Kernel, D, T>(); });
}

}  // namespace scree::benchmarks
