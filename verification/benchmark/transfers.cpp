// SPDX-License-Identifier: Apache-2.0
//
// Gather and scatter of some batches on one arena, everything in the first caches; without the
// prefetches for other blocks that the solver's scatter interleaves.
#include "solver/exec/cpu_group.hpp"
#include "verification/benchmark/benchmarks.hpp"
#include "verification/support/block_scene.hpp"

namespace scree::benchmarks {
namespace {

template <class Kernel, int D, class T>
class Load {
 public:
  using Group = CpuGroup<D, T, Kernel>;
  using V = typename Group::V;
  static constexpr int batches = 8;
  static constexpr int particles = batches * Group::width;

  Load() : arena_(Group::arena_values), group_(data_, arena_.data()), batch_(batches) {
    group_.begin(0);
    group_.stage_in(0);
    group_.clear(0);
    testing::Random random(11);
    for (Batch& b : batch_) fill(random, b);
    benchmark::DoNotOptimize(arena_.data());
    benchmark::DoNotOptimize(batch_.data());
  }

  void gather() {
    for (Batch& b : batch_) group_.gather_affine(0, b.stencil, b.velocity, b.affine);
    benchmark::ClobberMemory();
  }

  void scatter() {
    const V all = broadcast<V>(T(1));
    for (Batch& b : batch_) {
      group_.scatter_affine(0, b.stencil, b.momentum, b.mass, b.slopes, all);
    }
    benchmark::ClobberMemory();
  }

 private:
  struct Batch {
    decltype(Kernel::template Point<V, D>::stencil) stencil;
    V momentum[D], mass, slopes[D][D];  ///< to scatter
    V velocity[D], affine[D][D];        ///< gathered
  };

  static V any(testing::Random& random, double low, double high) {
    V v;
    for (int i = 0; i < lanes_of<V>; ++i) set_lane(v, i, T(random.uniform(low, high)));
    return v;
  }

  static void fill(testing::Random& random, Batch& b) {
    V u[D];
    for (V& x : u) x = any(random, home_begin, home_end);
    b.stencil = Kernel::template at<V, D>(u).stencil;
    b.mass = any(random, 0.5, 1);
    for (int c = 0; c < D; ++c) {
      b.momentum[c] = any(random, -1, 1);
      for (V& s : b.slopes[c]) s = any(random, -1, 1);
    }
  }

  testing::BlockScene<D, T> scene_{Kernel::lattices, {1}, 3};
  PassData<D, T> data_ = scene_.data();
  AlignedVector<T> arena_;
  Group group_;
  std::vector<Batch> batch_;
};

template <class Kernel, int D, class T>
void add_kernel() {
  const std::string kind = kind_name<Kernel, D, T>();
  add("gather_affine" + kind, [](benchmark::State& state) {
    Load<Kernel, D, T> load;
    for (auto _ : state) load.gather();
    count(state, load.particles, "particle");
  });
  add("scatter_affine" + kind, [](benchmark::State& state) {
    Load<Kernel, D, T> load;
    for (auto _ : state) load.scatter();
    count(state, load.particles, "particle");
  });
}

}  // namespace

void add_transfers() {
  for_every_kind([]<class Kernel, int D, class T> { add_kernel<Kernel, D, T>(); });
}

}  // namespace scree::benchmarks
