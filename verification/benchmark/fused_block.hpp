// SPDX-License-Identifier: Apache-2.0
/// \file
/// The fused pass over one block that stays in the cache; included where a law is compiled for it.
#pragma once

#include <algorithm>
#include <vector>

#include "materials/typical_input.hpp"
#include "solver/exec/cpu_group.hpp"
#include "solver/step/block_bodies.hpp"
#include "verification/benchmark/benchmarks.hpp"
#include "verification/support/block_scene.hpp"

namespace scree::benchmarks {

/// Strains of about 1e-3 a pass, to and fro, on particles that are stretched and sheared by up to a
/// tenth; 8 particles a cell in 3D, 4 in 2D.
template <class Material, class Kernel, int D, class T>
class FusedBlock {
 public:
  static constexpr int particles = block_node_count<D> * (1 << D);

  FusedBlock() : arena_(Group::arena_values), first_(particle_values()) {
    data_.layout = AuxLayout{};
    typename Material::Input input;
    set_typical_values(Material::schema(), &input, D);
    params_ = Material::template params<T>(input, 1700.0, D);
    std::copy_n(data_.particles, first_.size(), first_.begin());
    benchmark::DoNotOptimize(arena_.data());
  }

  void pass() {
    if (passes_ % cycle == 0) std::copy(first_.begin(), first_.end(), data_.particles);
    data_.parameters.dt = passes_++ % 2 == 0 ? T(1e-3) : T(-1e-3);
    data_.parameters.derive();
    Group group(data_, arena_.data());
    group.begin(0);
    g2p2g_block<Kernel, Material>(group, data_, params_);
    group.finish();
    benchmark::ClobberMemory();
  }

  bool faulty() const { return scene_.results[0].fault != FaultCode::none; }

 private:
  using Group = CpuGroup<D, T, Kernel>;
  using State = typename Material::template State<typename Group::V>;
  using Scene = testing::BlockScene<D, T>;
  /// Passes after which the particles start anew, lest second-order drift adds up. The copy is a
  /// thousandth of the time.
  static constexpr int cycle = 256;

  std::size_t particle_values() const {
    return scene_.store.batch_list().size() * std::size_t(scene_.store.fields() * Scene::width);
  }

  Scene scene_{Kernel::lattices, {particles}, 7, state_entries<State, typename Group::V> - 9};
  PassData<D, T> data_ = scene_.data();  // with the layout of a run that records nothing
  AlignedVector<T> arena_;
  typename Material::template Params<T> params_;
  std::vector<T> first_;
  int passes_ = 0;
};

template <class Material, class Kernel, int D, class T>
void add_fused_block() {
  add(std::string("g2p2g_block/") + Material::name + kind_name<Kernel, D, T>(),
      [](benchmark::State& state) {
        FusedBlock<Material, Kernel, D, T> block;
        for (auto _ : state) block.pass();
        if (block.faulty()) state.SkipWithError("a particle has left its block or its law");
        count(state, block.particles, "particle");
      });
}

/// Both kernels and precisions.
template <class Material, int D>
void add_fused_blocks() {
  add_fused_block<Material, Compact, D, float>();
  add_fused_block<Material, Compact, D, double>();
  add_fused_block<Material, Quadratic, D, float>();
  add_fused_block<Material, Quadratic, D, double>();
}

}  // namespace scree::benchmarks
