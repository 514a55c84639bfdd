// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstring>
#include <utility>

#include "solver/base/pack.hpp"
#include "solver/exec/lane_transfer.hpp"
#include "solver/exec/lattice_sums.hpp"
#include "solver/exec/line_transfer.hpp"
#include "solver/exec/row_arena.hpp"
#include "solver/exec/row_transfer.hpp"
#include "solver/step/batch_pair.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// One batch of a block, as many particles as a register has lanes: pointers to the first of them
/// in each field and the number of lanes that hold particles.
template <class T>
struct CpuBatch {
  T* particle;
  T* aux;
  std::int64_t* id;
  int active;
};

/// The CPU side of the backend seam: one thread works on one block at a time, a vector register
/// holds one quantity of a batch of particles, the arena lies in the thread's L1/L2. The store's
/// vectors of 64 bytes are one batch or several, as registers are.
///
/// Bodies see only these primitives (architecture page); the CUDA group offers the same ones with
/// one particle a thread. Grid values are gathered and scattered as quads {vector, mass}: all
/// quantities of a node side by side, one particle at a time; everything else is lanes =
/// particles, with register transposes between. Quads are kept in rows of neighbouring nodes
/// (RowArena), and affine transfers use whole rows (RowTransfer, LineTransfer).
template <int D, class T, class Kernel>
class CpuGroup {
 public:
  using Real = T;
  using V = RegisterLanes<T>;
  using Int = IntOf<V>;
  using Batch = CpuBatch<T>;
  static constexpr int max_set = 2;
  /// Whether fused passes may serve runs with pore water that flows.
  static constexpr bool takes_pore_water = true;
  using Shape = ArenaShape<Kernel, D>;
  static constexpr int dimension = D;
  static constexpr int width = lanes_of<V>;
  static constexpr int channels = 2;
  using Arena = RowArena<Kernel, D, T>;
  static constexpr int channel_values = Arena::values;
  /// Numbers of arena memory a thread needs.
  static constexpr int arena_values = 2 * channels * channel_values;

  CpuGroup(const PassData<D, T>& data, T* arena) : data_(data), arena_(arena) {}

  void begin(int block) {
    block_ = block;
    find_nodes(block, nodes_of_);
    result_ = BlockResult<T>{};
    speed_ = signal_ = excursion_ = broadcast<V>(T(0));
  }

  /// Names the block that this thread takes next: its grid values are fetched meanwhile.
  void expect(int block) {
    expects_ = true;
    find_nodes(block, next_nodes_of_);
  }

  /// Copies the grid's nodes around the block into the arena.
  void stage_in(int channel) {
    if constexpr (Arena::stride == node_values) {
      copy_nodes(data_.read[channel], read_arena(channel));
    } else {
      alignas(64) T nodes[Shape::values];
      copy_nodes(data_.read[channel], nodes);
      Arena::fill(nodes, read_arena(channel));
    }
  }

  void clear(int channel) {
    sums_ = true;
    Arena::clear(sum_arena(channel));
  }
  void sync() {}

  /// Adds the arena's sums to the grid; blocks of one colour touch disjoint nodes.
  void stage_out(int channel) {
    if constexpr (Arena::stride == node_values) {
      add_nodes(sum_arena(channel), data_.write[channel]);
    } else {
      alignas(64) T nodes[Shape::values];
      Arena::sum(sum_arena(channel), nodes);
      add_nodes(nodes, data_.write[channel]);
    }
  }

  template <class F>
  void each_batch(F&& f) {
    const int count = begin_batches();
    for (int n = 0; n < count; ++n) {
      if (n % pieces == 0 && n + pieces < count) prefetch(n / pieces + 1);
      f(batch(n));
    }
  }

  /// The same for `size` batches at a time, one or two. What the next set needs is asked for in two
  /// parts: a processor follows a dozen misses or so at a time, and waits where more are asked for.
  template <int size, class F>
  void each_set(F&& f) {
    if constexpr (size == 1) {
      each_batch([&](const Batch& b) __attribute__((always_inline)) {
        f(BatchSet<Batch, 1>{{b}, 1});
      });
    } else {
      const int count = begin_batches();
      for (int n = 0; n < count; n += 2) {
        if (n + 2 < count) prefetch((n + 2) / pieces);
        due_ = pieces == 1 && n + 3 < count ? n + 3 : 0;
        BatchSet<Batch, 2> set{{batch(n), batch(n)}, 1};
        set.batch[1].active = 0;
        if (n + 1 < count) {
          set.batch[1] = batch(n + 1);
          set.parts = 2;
        }
        f(set);
      }
    }
  }

  V load(const Batch& b, int field) const { return scree::load<V>(b.particle + field * stored); }
  void store(const Batch& b, int field, const V& x) {
    scree::store(b.particle + field * stored, x);
  }
  /// x, what the store holds in that field: a group short of registers reads it anew.
  V load_again(const Batch&, int, const V& x) const { return x; }
  V load_aux(const Batch& b, int field) const { return scree::load<V>(b.aux + field * stored); }
  void store_aux(const Batch& b, int field, const V& x) { scree::store(b.aux + field * stored, x); }

  MaskOf<V> active(const Batch& b) const { return first_lanes<V>(b.active); }
  T block_origin(int axis) const { return T(block_cells) * T(data_.coords[block_ * D + axis]); }

  /// value = sum w v, moment[c][a] = sum w v_c n_a, n = node number 0, 1, ... from the lowest.
  template <int S>
  void gather_moments(int channel, const Int& base, const V (&w)[D][S], V (&value)[D],
                      V (&moment)[D][D]) const {
    LaneSums::template gather<S, false>(read_arena(channel), base, w, w, value, moment);
  }

  /// value = sum w v, gradient[c][a] = sum v_c dw/dx_a [per cell].
  template <int S>
  void gather_slopes(int channel, const Int& base, const V (&w)[D][S], const V (&slope)[D][S],
                     V (&value)[D], V (&gradient)[D][D]) const {
    LaneSums::template gather<S, true>(read_arena(channel), base, w, slope, value, gradient);
  }

  /// Adds w (q + sum_a n_a m[.][a]) and mass w m to the nodes, for the lanes of `mask`.
  template <int S>
  void scatter_moments(int channel, const Int& base, const V (&w)[D][S], const V (&q)[D],
                       const V& mass, const V (&m)[D][D], const V& mask) {
    LaneSums::template scatter<S, false>(sum_arena(channel), base, w, w, q, mass, m, mask);
  }

  /// Adds w q + sum_a dw/dx_a g[.][a] and mass w m to the nodes, for the lanes of `mask`.
  template <int S>
  void scatter_slopes(int channel, const Int& base, const V (&w)[D][S], const V (&slope)[D][S],
                      const V (&q)[D], const V& mass, const V (&g)[D][D], const V& mask) {
    LaneSums::template scatter<S, true>(sum_arena(channel), base, w, slope, q, mass, g, mask);
  }

  /// velocity = sum over all lattices of w v; affine = sum of w v (x_i - x_p)^T.
  template <int L, int S>
  void gather_affine(int channel, const Stencil<V, D, L, S>& p, V (&velocity)[D],
                     V (&affine)[D][D]) const {
    if constexpr (L == 2 && S == 2) {
      Cells::gather(read_arena(channel), p, velocity, affine);
    } else if constexpr (L == 1 && S == 3) {
      Lines::gather(read_arena(channel), p, velocity, affine);
    } else {
      LatticeSums::gather_affine(*this, channel, p, velocity, affine);
    }
  }

  /// Adds w (q + A (x_i - x_p)) and mass w m to the nodes of all lattices, for the lanes of `mask`.
  template <int L, int S>
  void scatter_affine(int channel, const Stencil<V, D, L, S>& p, const V (&q)[D], const V& mass,
                      const V (&affine)[D][D], const V& mask) {
    prefetch_share();
    if (due_ > 0) prefetch(std::exchange(due_, 0));
    if constexpr (L == 2 && S == 2) {
      Cells::scatter(sum_arena(channel), p, q, mass, affine, mask);
    } else if constexpr (L == 1 && S == 3) {
      Lines::scatter(sum_arena(channel), p, q, mass, affine, mask);
    } else {
      LatticeSums::scatter_affine(*this, channel, p, q, mass, affine, mask);
    }
  }

  /// Maxima over the lanes of `mask`: component speed, wave speed + speed, stray [cells].
  void note_motion(const MaskOf<V>& mask, const V& speed, const V& excursion) {
    speed_ = max(speed_, select(mask, speed, broadcast<V>(T(0))));
    excursion_ = max(excursion_, select(mask, excursion, broadcast<V>(T(0))));
  }
  void note_signal(const MaskOf<V>& mask, const V& signal) {
    signal_ = max(signal_, select(mask, signal, broadcast<V>(T(0))));
  }

  /// Records the block's first fault.
  void fault(const MaskOf<V>& mask, FaultCode code, const V& value, const V (&u)[D],
             const Batch& b) {
    if (result_.fault != FaultCode::none || !any(mask)) return;
    for (int l = 0; l < b.active; ++l) {
      if (!lane(mask, l)) continue;
      result_.fault = code;
      result_.fault_id = b.id[l];
      result_.fault_value = lane(value, l);
      for (int a = 0; a < D; ++a) result_.fault_position[a] = lane(u[a], l);
      return;
    }
  }

  /// Marks particles that left through an open face; the next binning drops them.
  void remove(const MaskOf<V>& mask, const Batch& b) {
    if (!any(mask)) return;
    for (int l = 0; l < b.active; ++l) {
      if (!lane(mask, l)) continue;
      b.id[l] = -1;
      ++result_.dead;
    }
  }

  void finish() {
    for (int l = 0; l < width; ++l) {
      result_.max_speed = std::max(result_.max_speed, lane(speed_, l));
      result_.max_signal = std::max(result_.max_signal, lane(signal_, l));
      result_.max_excursion = std::max(result_.max_excursion, lane(excursion_, l));
    }
    data_.results[block_] = result_;
  }

 protected:
  static constexpr int stored = lanes_of<Lanes<T>>;  ///< numbers of a vector in the store
  static constexpr int pieces = stored / width;      ///< batches in it
  /// Numbers from a node's row to the next one's on the last axis but one, and on the first (3D).
  static constexpr int line = Shape::extent * Arena::stride;
  static constexpr int plane = Shape::extent * line;
  using LaneSums = LaneTransfer<D, T, Arena::stride, plane / node_values,
                                Arena::line_step / node_values, Arena::node_step / node_values>;
  using Cells = RowTransfer<D, T, Arena::stride, plane, Arena::line_step>;
  using Lines = LineTransfer<D, T, Arena::stride, plane, line>;
  typedef T Quad __attribute__((vector_size(4 * sizeof(T)), may_alias));

  T* read_arena(int channel) const { return arena_ + channel * channel_values; }
  T* sum_arena(int channel) const { return arena_ + (channels + channel) * channel_values; }

  void copy_nodes(const T* grid, T* nodes) const {
    each_run<Kernel, D>(0, arena_lines<Kernel, D>, [&](auto count, int first, NodePlace place) {
      const Quad* from = reinterpret_cast<const Quad*>(record(grid, place));
      Quad* to = reinterpret_cast<Quad*>(nodes + first * node_values);
      for (int i = 0; i < count; ++i) to[i] = from[i];
    });
  }

  void add_nodes(const T* nodes, T* grid) const {
    each_run<Kernel, D>(0, arena_lines<Kernel, D>, [&](auto count, int first, NodePlace place) {
      const Quad* from = reinterpret_cast<const Quad*>(nodes + first * node_values);
      Quad* to = reinterpret_cast<Quad*>(record(grid, place));
      for (int i = 0; i < count; ++i) to[i] += from[i];
    });
  }

  /// This batch's share of the grid values that are needed when the block is done and at the next
  /// one's begin. Amid a batch: a processor follows about a dozen misses at a time, and those of
  /// the next batch have just been asked for.
  [[gnu::always_inline]] void prefetch_share() {
    if (sums_) prefetch_nodes(data_.write[0], nodes_of_, line_, line_ + share_);
    if (expects_) prefetch_nodes(data_.read[0], next_nodes_of_, line_, line_ + share_);
    line_ += share_;
  }

  /// Fetches the grid values of some lines of the arena into the second cache. (Always inlined: GCC
  /// 12 drops calls that do nothing but prefetch. Not with the intent to write: a processor with
  /// AVX-512 waits longer for that.)
  [[gnu::always_inline]] void prefetch_nodes(const T* grid, const std::size_t* nodes_of,
                                             int first_line, int last_line) const {
    const auto fetch = [&](auto count, int, NodePlace place) __attribute__((always_inline)) {
      const T* p = grid + nodes_of[place.neighbour] + place.node * node_values;
      for (int i = 0; i < count * node_values; i += 64 / int(sizeof(T))) {
        __builtin_prefetch(p + i, 0, 2);
      }
    };
    each_run<Kernel, D>(first_line, last_line, fetch);
  }

  /// The topology's numbers of the blocks around `block`.
  const std::int32_t* around(int block) const {
    return data_.neighbours + data_.grid_block[block] * neighbour_count<D>;
  }

  /// First value of the nodes of each block around `block`; all of them are active (Topology).
  void find_nodes(int block, std::size_t (&nodes_of)[neighbour_count<D>]) const {
    const std::int32_t* blocks = around(block);
    for (int n = 0; n < neighbour_count<D>; ++n) {
      nodes_of[n] = std::size_t(blocks[n]) * Kernel::lattices * block_node_count<D> * node_values;
    }
  }

  template <class P>
  P* record(P* grid, const NodePlace& place) const {
    return grid + nodes_of_[place.neighbour] + place.node * node_values;
  }

  /// Number of batches with particles in the block.
  int batches() const { return (data_.counts[block_] + width - 1) / width; }

  /// The same; shares what is to be prefetched among them.
  int begin_batches() {
    const int count = batches();
    share_ = (arena_lines<Kernel, D> - 1) / std::max(count, 1) + 1;
    line_ = 0;
    return count;
  }

  Batch batch(int n) const {
    const std::size_t b = stored_batch(n / pieces);
    const int lane = n % pieces * width;
    return {data_.particles + b * data_.fields * stored + lane,
            data_.aux + b * data_.layout.total * stored + lane, data_.ids + b * stored + lane,
            std::min(width, data_.counts[block_] - n * width)};
  }

  /// Place in the store of the block's i-th vectors.
  std::size_t stored_batch(int i) const {
    return std::size_t(data_.batch_list[data_.batch_begin[block_] + i]);
  }

  /// Fetches the block's i-th vectors into the second cache. (Always inlined, as prefetch_nodes.)
  [[gnu::always_inline]] void prefetch(int i) const {
    const T* p = data_.particles + stored_batch(i) * data_.fields * stored;
    for (int f = 0; f < data_.fields; ++f) __builtin_prefetch(p + f * stored, 0, 2);
    const int growth = data_.stride.fields.growth;
    if (growth < 0) return;
    const T* q = data_.aux + (stored_batch(i) * data_.layout.total + growth) * stored;
    for (int f = 0; f < 2; ++f) __builtin_prefetch(q + f * stored, 0, 2);  // growth, gained
  }

  const PassData<D, T>& data_;
  T* arena_;
  int block_ = 0;
  std::size_t nodes_of_[neighbour_count<D>];
  std::size_t next_nodes_of_[neighbour_count<D>];
  bool expects_ = false;
  bool sums_ = false;
  int line_ = 0;   ///< first line of the arena that the next scatter prefetches
  int share_ = 0;  ///< lines a batch
  int due_ = 0;    ///< vectors that the next scatter prefetches, or 0
  BlockResult<T> result_;
  V speed_;
  V signal_;
  V excursion_;
};

}  // namespace scree
