// SPDX-License-Identifier: Apache-2.0
//
// The CUDA group without a GPU: threads of the host stand for the threads of a block. Shows that
// its indices, strides, sums and results are those of CpuGroup; a thread sanitizer sees its races.
#include "solver/exec/cuda_group.cuh"

#include <gtest/gtest.h>

#include <barrier>
#include <cmath>
#include <limits>
#include <thread>

#include "materials/fixed_corotated.hpp"
#include "solver/exec/cpu_group.hpp"
#include "solver/step/block_bodies.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"
#include "verification/support/block_scene.hpp"

namespace scree::testing {
namespace {

constexpr int block_threads = 5;  // divides neither nodes nor batches

template <int Dimension, class Real, class KernelType>
struct Case {
  static constexpr int D = Dimension;
  using T = Real;
  using Kernel = KernelType;
};
using Cases = ::testing::Types<Case<2, double, Compact>, Case<2, float, Quadratic>,
                               Case<3, float, Compact>, Case<3, double, Quadratic>>;

template <class C>
struct CudaGroupThreads : ::testing::Test {
  static constexpr int D = C::D;
  using T = typename C::T;
  using Kernel = typename C::Kernel;
  using Scene = BlockScene<D, T>;
  using Cpu = CpuGroup<D, T, Kernel>;
  template <int Reads, int Sums>
  using Gpu = CudaGroup<D, T, Kernel, Reads, Sums, Scene::width>;

  Scene cpu{Kernel::lattices, {61, 5, 200}, 13};
  Scene gpu{Kernel::lattices, {61, 5, 200}, 13};
  PassData<D, T> cpu_data = cpu.data();
  PassData<D, T> gpu_data = gpu.data();

  /// A launch: body(group) by all threads of every block.
  template <class Group, class Body>
  void launch(const Body& body) {
    using Barrier = std::barrier<>;
    for (int block = 0; block < int(gpu.store.blocks().size()); ++block) {
      std::vector<T> arena(std::size_t(Group::Arena::values) + 1,
                           std::numeric_limits<T>::quiet_NaN());
      Barrier barrier(block_threads);
      const auto thread = [&](int index) {
        const auto wait = [](void* b) { static_cast<Barrier*>(b)->arrive_and_wait(); };
        cuda::host_thread = {index, block_threads, wait, &barrier};
        Group group(gpu_data, arena.data(), block);
        body(group);
        group.finish();
      };
      std::vector<std::thread> team;
      for (int i = 0; i < block_threads; ++i) team.emplace_back(thread, i);
      for (std::thread& t : team) t.join();
    }
  }

  static void expect_near(const auto& a, const auto& b, T tolerance, const char* what, int index) {
    T largest = 0;
    for (const T x : a) largest = std::max(largest, std::abs(x));
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_NEAR(a[i], b[i], tolerance * largest) << what << " " << index << ", entry " << i;
    }
  }

  /// The order of sums differs: up to about 100 terms at a node, 27 at a particle; the inverse of
  /// the compact moment matrix magnifies the latter by less than 20.
  void expect_same() {
    const T tolerance = 1000 * std::numeric_limits<T>::epsilon();
    for (int f = 0; f < Scene::fields; ++f) {
      expect_near(cpu.field(f), gpu.field(f), tolerance, "field", f);
    }
    for (int f = 0; f < cpu.layout.total; ++f) {
      expect_near(cpu.field(f, true), gpu.field(f, true), tolerance, "aux field", f);
    }
    for (int c = 0; c < 2; ++c) expect_near(cpu.write[c], gpu.write[c], tolerance, "channel", c);
    for (std::size_t b = 0; b < cpu.results.size(); ++b) {
      const BlockResult<T>& x = cpu.results[b];
      const BlockResult<T>& y = gpu.results[b];
      EXPECT_NEAR(x.max_speed, y.max_speed, tolerance);
      EXPECT_NEAR(x.max_signal, y.max_signal, tolerance * x.max_signal);
      EXPECT_NEAR(x.max_excursion, y.max_excursion, tolerance);
      EXPECT_EQ(x.fault, y.fault);
      EXPECT_EQ(x.dead, y.dead);
    }
  }
};
TYPED_TEST_SUITE(CudaGroupThreads, Cases);

TYPED_TEST(CudaGroupThreads, ParticlesToGrid) {
  using Kernel = typename TypeParam::Kernel;
  using Group = typename TestFixture::template Gpu<0, 2>;
  using Cpu = typename TestFixture::Cpu;
  this->cpu_data.parameters.separate_force = this->gpu_data.parameters.separate_force = true;
  this->cpu.template run<Cpu>(this->cpu_data,
                              [&](Cpu& g) { p2g_block<Kernel, Mls<Kernel>>(g, this->cpu_data); });
  this->template launch<Group>(
      [&](Group& g) { p2g_block<Kernel, Mls<Kernel>>(g, this->gpu_data); });
  this->expect_same();
}

TYPED_TEST(CudaGroupThreads, GridToParticles) {
  using Kernel = typename TypeParam::Kernel;
  using Group = typename TestFixture::template Gpu<2, 0>;
  using Cpu = typename TestFixture::Cpu;
  this->cpu.template run<Cpu>(
      this->cpu_data, [&](Cpu& g) { g2p_block<Kernel, Pic<Kernel, true>>(g, this->cpu_data); });
  this->template launch<Group>(
      [&](Group& g) { g2p_block<Kernel, Pic<Kernel, true>>(g, this->gpu_data); });
  this->expect_same();
}

TYPED_TEST(CudaGroupThreads, Fused) {
  using Kernel = typename TypeParam::Kernel;
  using T = typename TypeParam::T;
  using Group = typename TestFixture::template Gpu<1, 1>;
  using Cpu = typename TestFixture::Cpu;
  const FixedCorotated::Params<T> material{T(10), T(5), T(1)};
  this->cpu_data.parameters.record = this->gpu_data.parameters.record = true;
  this->cpu.template run<Cpu>(this->cpu_data, [&](Cpu& g) {
    g2p2g_block<Kernel, FixedCorotated>(g, this->cpu_data, material);
  });
  this->template launch<Group>(
      [&](Group& g) { g2p2g_block<Kernel, FixedCorotated>(g, this->gpu_data, material); });
  this->expect_same();
}

TYPED_TEST(CudaGroupThreads, FaultsAndRemovals) {
  using Kernel = typename TypeParam::Kernel;
  using T = typename TypeParam::T;
  using Group = typename TestFixture::template Gpu<1, 1>;
  using Cpu = typename TestFixture::Cpu;
  const FixedCorotated::Params<T> material{T(10), T(5), T(1)};
  for (auto* data : {&this->cpu_data, &this->gpu_data}) {
    data->parameters.alive_lower[0] = T(2);                   // an open face across the blocks
    data->parameters.closed_upper[TypeParam::D - 1] = T(10);  // a closed one across block 2
  }
  this->cpu.template run<Cpu>(this->cpu_data, [&](Cpu& g) {
    g2p2g_block<Kernel, FixedCorotated>(g, this->cpu_data, material);
  });
  this->template launch<Group>(
      [&](Group& g) { g2p2g_block<Kernel, FixedCorotated>(g, this->gpu_data, material); });
  int dead = 0;
  for (std::size_t b = 0; b < this->cpu.results.size(); ++b) {
    const auto& x = this->cpu.results[b];
    const auto& y = this->gpu.results[b];
    EXPECT_EQ(x.dead, y.dead);
    dead += x.dead;
    EXPECT_EQ(x.fault, b == 2 ? FaultCode::left_domain : FaultCode::none);
    EXPECT_EQ(y.fault, x.fault);
    if (b < 2) continue;
    // Which particle is reported is left to chance; all of its numbers must be of one particle.
    EXPECT_GT(y.fault_value, 0);
    EXPECT_NEAR(double(y.fault_position[TypeParam::D - 1]), double(y.fault_value) + 10 - 8, 1e-5);
    EXPECT_GE(y.fault_id, 61 + 5);
  }
  EXPECT_GT(dead, 20);
  const std::int64_t slots = this->cpu.store.count();
  for (std::int64_t i = 0; i < slots; ++i)
    EXPECT_EQ(this->cpu.store.ids(0)[i], this->gpu.store.ids(0)[i]);
}

}  // namespace
}  // namespace scree::testing
