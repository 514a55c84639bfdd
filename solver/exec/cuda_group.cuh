// SPDX-License-Identifier: Apache-2.0
/// \file
/// The CUDA side of the backend seam: the same primitives as CpuGroup, one particle a thread.
#pragma once

#include "solver/base/pack.hpp"
#include "solver/exec/arena.hpp"
#include "solver/exec/cuda_leaves.cuh"
#include "solver/exec/lattice_sums.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// One particle: pointers to its entry of the first field of its batch.
template <class T>
struct CudaBatch {
  T* particle;
  T* aux;
  std::int64_t* id;
};

/// A block's arena in shared memory, component after component, so that neighbouring nodes lie in
/// neighbouring banks: `Reads` channels of D velocities, then `Sums` channels of D momenta and
/// mass.
template <int D, class T, class Kernel, int Reads, int Sums>
struct CudaArena {
  static constexpr int nodes = ArenaShape<Kernel, D>::nodes;
  static constexpr int sums_begin = Reads * D * nodes;
  static constexpr int values = sums_begin + Sums * (D + 1) * nodes;
  T value[values];
};

/// A CUDA thread block works on one grid block. `Width` is the number of particles in a batch of
/// the store; threads of a warp then read consecutive memory. Faults and maxima go to the block's
/// result in global memory; which of several faults is recorded is left to chance.
///
/// Members are host-device functions because the bodies are; they only make sense in a kernel.
template <int D, class T, class Kernel, int Reads, int Sums, int Width = 32>
class CudaGroup {
 public:
  using Real = T;
  using V = T;
  using Int = IntOf<V>;
  using Batch = CudaBatch<T>;
  using Shape = ArenaShape<Kernel, D>;
  using Arena = CudaArena<D, T, Kernel, Reads, Sums>;
  static constexpr int dimension = D;
  static constexpr int width = Width;

  /// arena: in shared memory; null for passes that stage nothing.
  SCREE_FN CudaGroup(const PassData<D, T>& data, T* arena, int block)
      : data_(data), arena_(arena), block_(block) {
    if (cuda::thread() == 0) data_.results[block_] = BlockResult<T>{};
    cuda::barrier();
  }

  /// Copies the velocities of the grid's nodes around the block into the arena.
  SCREE_FN void stage_in(int channel) {
    const T* grid = data_.read[channel];
    T* out = read_arena(channel);
    for (int n = cuda::thread(); n < Shape::nodes; n += cuda::threads()) {
      const std::int64_t from = record(n);
      for (int c = 0; c < D; ++c) {
        out[c * Shape::nodes + n] = from < 0 ? T(0) : grid[from + c];
      }
    }
  }

  SCREE_FN void clear(int channel) {
    T* sums = sum_arena(channel);
    for (int n = cuda::thread(); n < (D + 1) * Shape::nodes; n += cuda::threads()) sums[n] = T(0);
  }

  SCREE_FN void sync() { cuda::barrier(); }

  /// Adds the arena's sums to the grid; other blocks may do so at the same time.
  SCREE_FN void stage_out(int channel) {
    T* grid = data_.write[channel];
    const T* sums = sum_arena(channel);
    for (int n = cuda::thread(); n < Shape::nodes; n += cuda::threads()) {
      const std::int64_t to = record(n);
      if (to < 0) continue;
      for (int c = 0; c <= D; ++c) {
        cuda::add(grid + to + (c < D ? c : mass_slot), sums[c * Shape::nodes + n]);
      }
    }
  }

  template <class F>
  SCREE_FN void each_batch(F&& f) {
    const int first = data_.batch_begin[block_];
    const int count = data_.counts[block_];
    for (int p = cuda::thread(); p < count; p += cuda::threads()) {
      f(batch(data_.batch_list[first + p / width], p % width));
    }
  }

  SCREE_FN V load(const Batch& b, int field) const { return b.particle[field * width]; }
  SCREE_FN void store(const Batch& b, int field, V x) { b.particle[field * width] = x; }
  SCREE_FN V load_aux(const Batch& b, int field) const { return b.aux[field * width]; }
  SCREE_FN void store_aux(const Batch& b, int field, V x) { b.aux[field * width] = x; }

  SCREE_FN bool active(const Batch&) const { return true; }
  SCREE_FN T block_origin(int axis) const {
    return T(block_cells) * T(data_.coords[block_ * D + axis]);
  }

  /// The grid transfers, as documented at CpuGroup.
  template <int S>
  SCREE_FN void gather_moments(int channel, Int base, const V (&w)[D][S], V (&value)[D],
                               V (&moment)[D][D]) const {
    V alt[D][S];
    numbered(w, alt);
    gather(channel, base, w, alt, value, moment);
  }
  template <int L, int S>
  SCREE_FN void gather_affine(int channel, const Stencil<V, D, L, S>& p, V (&velocity)[D],
                              V (&affine)[D][D]) const {
    LatticeSums::gather_affine(*this, channel, p, velocity, affine);
  }
  template <int L, int S>
  SCREE_FN void scatter_affine(int channel, const Stencil<V, D, L, S>& p, const V (&q)[D],
                               const V& mass, const V (&affine)[D][D], const V& mask) {
    LatticeSums::scatter_affine(*this, channel, p, q, mass, affine, mask);
  }
  template <int S>
  SCREE_FN void gather_slopes(int channel, Int base, const V (&w)[D][S], const V (&slope)[D][S],
                              V (&value)[D], V (&gradient)[D][D]) const {
    gather(channel, base, w, slope, value, gradient);
  }
  template <int S>
  SCREE_FN void scatter_moments(int channel, Int base, const V (&w)[D][S], const V (&q)[D], V mass,
                                const V (&m)[D][D], V mask) {
    V alt[D][S];
    numbered(w, alt);
    scatter(channel, base, w, alt, q, mass, m, mask);
  }
  template <int S>
  SCREE_FN void scatter_slopes(int channel, Int base, const V (&w)[D][S], const V (&slope)[D][S],
                               const V (&q)[D], V mass, const V (&g)[D][D], V mask) {
    scatter(channel, base, w, slope, q, mass, g, mask);
  }

  SCREE_FN void note_motion(bool mask, V speed, V excursion) {
    speed_ = max(speed_, select(mask, speed, V(0)));
    excursion_ = max(excursion_, select(mask, excursion, V(0)));
  }
  SCREE_FN void note_signal(bool mask, V signal) {
    signal_ = max(signal_, select(mask, signal, V(0)));
  }

  SCREE_FN void fault(bool mask, FaultCode code, V value, const V (&u)[D], const Batch& b) {
    if (!mask) return;
    BlockResult<T>& result = data_.results[block_];
    if (!cuda::claim(&result.fault, FaultCode::none, code)) return;
    result.fault_id = *b.id;
    result.fault_value = value;
    for (int a = 0; a < D; ++a) result.fault_position[a] = u[a];
  }

  SCREE_FN void remove(bool mask, const Batch& b) {
    if (!mask) return;
    *b.id = -1;
    cuda::add(&data_.results[block_].dead, 1);
  }

  SCREE_FN void finish() {
    BlockResult<T>& result = data_.results[block_];
    cuda::raise(&result.max_speed, speed_);
    cuda::raise(&result.max_signal, signal_);
    cuda::raise(&result.max_excursion, excursion_);
  }

 private:
  SCREE_FN T* read_arena(int channel) const { return arena_ + channel * D * Shape::nodes; }
  SCREE_FN T* sum_arena(int channel) const {
    return arena_ + Arena::sums_begin + channel * (D + 1) * Shape::nodes;
  }

  /// First value of an arena node's grid record, -1 if its block is not active.
  SCREE_FN std::int64_t record(int n) const {
    const NodePlace place = arena_place<Kernel, D>(n);
    const std::int32_t block =
        data_.neighbours[data_.grid_block[block_] * neighbour_count<D> + place.neighbour];
    if (block < 0) return -1;
    constexpr int nodes = Kernel::lattices * block_node_count<D>;
    return (std::int64_t(block) * nodes + place.node) * node_values;
  }

  SCREE_FN Batch batch(std::int32_t b, int lane) const {
    const std::int64_t at = std::int64_t(b) * width;
    return {data_.particles + at * data_.fields + lane, data_.aux + at * data_.layout.total + lane,
            data_.ids + at + lane};
  }

  /// Weights times the node number, for moments.
  template <int S>
  static SCREE_FN void numbered(const V (&w)[D][S], V (&alt)[D][S]) {
    SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) {
      SCREE_UNROLL_ON_DEVICE for (int s = 0; s < S; ++s) alt[a][s] = V(s) * w[a][s];
    }
  }

  /// Offset of node s of the stencil (0 .. S^D - 1, last axis fastest) and its number on each axis.
  template <int S>
  static SCREE_FN int stencil_node(int s, int (&number)[D]) {
    int offset = 0;
    int stride = 1;
    SCREE_UNROLL_ON_DEVICE for (int a = D - 1; a >= 0; --a) {
      number[a] = s % S;
      offset += number[a] * stride;
      stride *= Shape::extent;
      s /= S;
    }
    return offset;
  }

  /// products[0] = prod w, products[1 + a] = the same with the weight of axis a replaced by alt.
  template <int S>
  static SCREE_FN void weight_products(const V (&w)[D][S], const V (&alt)[D][S],
                                       const int (&number)[D], V (&products)[1 + D]) {
    SCREE_UNROLL_ON_DEVICE for (int p = 0; p <= D; ++p) {
      products[p] = V(1);
      SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) {
        products[p] *= p == a + 1 ? alt[a][number[a]] : w[a][number[a]];
      }
    }
  }

  template <int S>
  SCREE_FN void gather(int channel, Int base, const V (&w)[D][S], const V (&alt)[D][S],
                       V (&value)[D], V (&moment)[D][D]) const {
    const T* nodes = read_arena(channel) + base;
    SCREE_UNROLL_ON_DEVICE for (int c = 0; c < D; ++c) {
      value[c] = V(0);
      SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) moment[c][a] = V(0);
    }
    SCREE_UNROLL_ON_DEVICE for (int s = 0; s < power(S, D); ++s) {
      int number[D];
      V products[1 + D];
      const int offset = stencil_node<S>(s, number);
      weight_products(w, alt, number, products);
      SCREE_UNROLL_ON_DEVICE for (int c = 0; c < D; ++c) {
        const V v = nodes[c * Shape::nodes + offset];
        value[c] += products[0] * v;
        SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) moment[c][a] += products[1 + a] * v;
      }
    }
  }

  template <int S>
  SCREE_FN void scatter(int channel, Int base, const V (&w)[D][S], const V (&alt)[D][S],
                        const V (&q)[D], V mass, const V (&m)[D][D], V mask) {
    if (mask == V(0)) return;
    T* nodes = sum_arena(channel) + base;
    SCREE_UNROLL_ON_DEVICE for (int s = 0; s < power(S, D); ++s) {
      int number[D];
      V products[1 + D];
      const int offset = stencil_node<S>(s, number);
      weight_products(w, alt, number, products);
      SCREE_UNROLL_ON_DEVICE for (int c = 0; c < D; ++c) {
        V sum = products[0] * q[c];
        SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) sum += products[1 + a] * m[c][a];
        cuda::add(nodes + c * Shape::nodes + offset, sum);
      }
      cuda::add(nodes + D * Shape::nodes + offset, products[0] * mass);
    }
  }

  const PassData<D, T>& data_;
  T* arena_;
  int block_;
  V speed_ = 0;
  V signal_ = 0;
  V excursion_ = 0;
};

}  // namespace scree
