// SPDX-License-Identifier: Apache-2.0
/// \file
/// The CUDA side of the backend seam: the same primitives as CpuGroup, one particle a thread.
#pragma once

#include <type_traits>

#include "solver/base/pack.hpp"
#include "solver/device/device.hpp"
#include "solver/device/pool_entry.hpp"
#include "solver/exec/arena.hpp"
#include "solver/exec/cuda_leaves.cuh"
#include "solver/exec/cuda_sums.cuh"
#include "solver/step/batch_pair.hpp"
#include "solver/step/pass_data.hpp"
#include "solver/transfer/stencil.hpp"

namespace scree {
inline namespace SCREE_SIDE {

/// One particle: its lane among all of the body. (A number, not pointers: these take registers.)
struct CudaBatch {
  std::int32_t lane;
};

/// A block's arena in shared memory, component after component, so that neighbouring nodes lie in
/// neighbouring banks: `Reads` channels of D velocities, then `Sums` channels of D momenta and
/// mass. Both of type Value.
template <int D, class Value, class Kernel, int Reads, int Sums>
struct CudaArena {
  static constexpr int nodes = ArenaShape<Kernel, D>::nodes;
  static constexpr int sums_begin = Reads * D * nodes;
  static constexpr int values = sums_begin + Sums * (D + 1) * nodes;
  Value value[values];
};

/// A CUDA thread block works on one grid block, whose batches lie side by side. Faults and maxima
/// go to the block's result in global memory; which of several faults is recorded is left to
/// chance. Summation: PlainSums or FixedSums.
///
/// Members are host-device functions because the bodies are; they only make sense in a kernel.
template <int D, class T, class Kernel, int Reads, int Sums,
          template <int, class> class Summation = PlainSums>
class CudaGroup : private Summation<D, T> {
  using Value = typename Summation<D, T>::Value;
  static_assert(Reads == 0 || std::is_same_v<Value, T>, "an arena holds numbers of one type");

 public:
  using Real = T;
  using V = T;
  using Int = IntOf<V>;
  using Batch = CudaBatch;
  static constexpr int max_set = 1;
  static constexpr bool takes_pore_water = false;  ///< and kernels need no registers for it
  using Shape = ArenaShape<Kernel, D>;
  using Arena = CudaArena<D, Value, Kernel, Reads, Sums>;
  static constexpr int dimension = D;
  static constexpr int width = device_width;

  /// arena: in shared memory; null for passes that stage nothing.
  SCREE_FN CudaGroup(const PassData<D, T>& data, Value* arena, int block,
                     const Summation<D, T>& summation = Summation<D, T>{})
      : Summation<D, T>(summation), data_(data), arena_(arena), block_(block) {
    if (device::thread() == 0) data_.results[block_] = BlockResult<T>{};
    device::barrier();
  }

  /// Copies the velocities of the grid's nodes around the block into the arena.
  SCREE_FN void stage_in(int channel) {
    const T* grid = data_.read[channel];
    T* out = read_arena(channel);
    for (int n = device::thread(); n < Shape::nodes; n += device::threads()) {
      const std::int64_t from = record(n);
      for (int c = 0; c < D; ++c) {
        out[c * Shape::nodes + n] = from < 0 ? T(0) : grid[from + c];
      }
    }
  }

  SCREE_FN void clear(int channel) {
    Value* sums = sum_arena(channel);
    for (int n = device::thread(); n < (D + 1) * Shape::nodes; n += device::threads())
      sums[n] = Value(0);
  }

  SCREE_FN void sync(CallPlace at = SCREE_CALL_PLACE) { device::barrier(at); }

  /// Adds the arena's sums to the grid; other blocks may do so at the same time.
  SCREE_FN void stage_out(int channel) {
    Value* grid = this->channel(data_, channel);
    const Value* sums = sum_arena(channel);
    for (int n = device::thread(); n < Shape::nodes; n += device::threads()) {
      const std::int64_t to = record(n);
      if (to < 0) continue;
      for (int c = 0; c <= D; ++c) {
        device::add(grid + to + (c < D ? c : mass_slot), sums[c * Shape::nodes + n]);
      }
    }
  }

  /// (One running number: the end is read anew each time rather than kept in a register.)
  template <class F>
  SCREE_FN void each_batch(F&& f) {
    int lane = data_.batch_begin[block_] * width + device::thread();
    while (lane < data_.batch_begin[block_] * width + data_.counts[block_]) {
      f(Batch{lane});
      lane += device::threads();
    }
  }

  template <int size, class F>
  SCREE_FN void each_set(F&& f) {
    static_assert(size == max_set);
    each_batch([&](const Batch& b) { f(BatchSet<Batch, 1>{{b}, 1}); });
  }

  SCREE_FN V load(const Batch& b, int field) const {
    return entry(data_.particles, data_.fields, b)[field * width];
  }
  SCREE_FN V load_again(const Batch& b, int field, V) const {
    return *static_cast<const volatile T*>(entry(data_.particles, data_.fields, b) + field * width);
  }
  SCREE_FN void store(const Batch& b, int field, V x) {
    entry(data_.particles, data_.fields, b)[field * width] = x;
  }
  SCREE_FN V load_aux(const Batch& b, int field) const {
    return entry(data_.aux, data_.layout.total, b)[field * width];
  }
  SCREE_FN void store_aux(const Batch& b, int field, V x) {
    entry(data_.aux, data_.layout.total, b)[device::not_ahead(field) * width] = x;
  }

  SCREE_FN bool active(const Batch&) const { return true; }
  SCREE_FN T block_origin(int axis) const {
    return T(block_cells) * T(data_.coords[block_ * D + axis]);
  }

  // The grid transfers, as documented at CpuGroup.

  /// Node by node of both lattices, with few numbers alive at a time: registers are what bounds the
  /// number of threads.
  template <int L, int S>
  SCREE_FN void gather_affine(int channel, const Stencil<V, D, L, S>& p, V (&velocity)[D],
                              V (&affine)[D][D]) const {
    for (int c = 0; c < D; ++c) {
      velocity[c] = V(0);
      for (int a = 0; a < D; ++a) affine[c][a] = V(0);
    }
    SCREE_UNROLL_ON_DEVICE for (int k = 0; k < L; ++k) {
      const T* nodes = read_arena(channel) + p.base[k];
      SCREE_UNROLL_ON_DEVICE for (int s = 0; s < power(S, D); ++s) {
        int number[D];
        const int offset = stencil_node<S>(s, number);
        const V w = weight_of(p.weight[k], number);
        SCREE_UNROLL_ON_DEVICE for (int c = 0; c < D; ++c) {
          const V part = w * nodes[c * Shape::nodes + offset];
          velocity[c] += part;
          SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) {
            affine[c][a] += part * (V(number[a]) + p.offset[k][a]);
          }
        }
      }
    }
  }
  template <int L, int S>
  SCREE_FN void scatter_affine(int channel, const Stencil<V, D, L, S>& p, const V (&q)[D],
                               const V& mass, const V (&affine)[D][D], const V& mask) {
    if (mask == V(0)) return;
    SCREE_UNROLL_ON_DEVICE for (int k = 0; k < L; ++k) {
      Value* nodes = sum_arena(channel) + p.base[k];
      SCREE_UNROLL_ON_DEVICE for (int s = 0; s < power(S, D); ++s) {
        int number[D];
        const int offset = stencil_node<S>(s, number);
        const V w = weight_of(p.weight[k], number);
        SCREE_UNROLL_ON_DEVICE for (int c = 0; c < D; ++c) {
          V momentum = q[c];
          SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) {
            momentum += affine[c][a] * (V(number[a]) + p.offset[k][a]);
          }
          this->add_momentum(nodes + c * Shape::nodes + offset, w * momentum);
        }
        this->add_mass(nodes + D * Shape::nodes + offset, w * mass);
      }
    }
  }
  template <int S>
  SCREE_FN void gather_slopes(int channel, Int base, const V (&w)[D][S], const V (&slope)[D][S],
                              V (&value)[D], V (&gradient)[D][D]) const {
    gather(channel, base, w, slope, value, gradient);
  }
  template <int S>
  SCREE_FN void scatter_slopes(int channel, Int base, const V (&w)[D][S], const V (&slope)[D][S],
                               const V (&q)[D], V mass, const V (&g)[D][D], V mask) {
    scatter(channel, base, w, slope, q, mass, g, mask);
  }

  /// Maxima go straight to the block's result: three running ones would take registers, and after
  /// the first particles few are larger.
  SCREE_FN void note_motion(bool mask, V speed, V excursion) {
    if (!mask) return;
    device::raise(&data_.results[block_].max_speed, speed);
    device::raise(&data_.results[block_].max_excursion, excursion);
  }
  SCREE_FN void note_signal(bool mask, V signal) {
    if (mask) device::raise(&data_.results[block_].max_signal, signal);
  }

  SCREE_FN void fault(bool mask, FaultCode code, V value, const V (&u)[D], const Batch& b) {
    if (!mask) return;
    BlockResult<T>& result = data_.results[block_];
    if (!device::claim(&result.fault, FaultCode::none, code)) return;
    result.fault_id = data_.ids[b.lane];
    result.fault_value = value;
    // A law reports after the position was stored, and need not keep it.
    const bool stored = code == FaultCode::inadmissible_state;
    for (int a = 0; a < D; ++a) result.fault_position[a] = stored ? load_again(b, a, u[a]) : u[a];
  }

  SCREE_FN void remove(bool mask, const Batch& b) {
    if (!mask) return;
    data_.ids[b.lane] = -1;
    device::add(&data_.results[block_].dead, 1);
  }

  SCREE_FN void finish() {}

 private:
  SCREE_FN T* read_arena(int channel) const { return arena_ + channel * D * Shape::nodes; }
  SCREE_FN Value* sum_arena(int channel) const {
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

  /// First field of a particle in a pool.
  static SCREE_FN T* entry(T* pool, int fields, const Batch& b) {
    return pool + pool_entry(b.lane, fields);
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

  template <int S>
  static SCREE_FN V weight_of(const V (&w)[D][S], const int (&number)[D]) {
    V product = w[0][number[0]];
    SCREE_UNROLL_ON_DEVICE for (int a = 1; a < D; ++a) product *= w[a][number[a]];
    return product;
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
    Value* nodes = sum_arena(channel) + base;
    SCREE_UNROLL_ON_DEVICE for (int s = 0; s < power(S, D); ++s) {
      int number[D];
      V products[1 + D];
      const int offset = stencil_node<S>(s, number);
      weight_products(w, alt, number, products);
      SCREE_UNROLL_ON_DEVICE for (int c = 0; c < D; ++c) {
        V sum = products[0] * q[c];
        SCREE_UNROLL_ON_DEVICE for (int a = 0; a < D; ++a) sum += products[1 + a] * m[c][a];
        this->add_momentum(nodes + c * Shape::nodes + offset, sum);
      }
      this->add_mass(nodes + D * Shape::nodes + offset, products[0] * mass);
    }
  }

  const PassData<D, T>& data_;
  Value* arena_;
  int block_;
};

}  // namespace SCREE_SIDE
}  // namespace scree
