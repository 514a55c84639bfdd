// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>

#include "solver/base/pack.hpp"
#include "solver/exec/arena.hpp"
#include "solver/exec/transpose.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// One batch of a block: pointers to its vectors and the number of lanes that hold particles.
template <class T>
struct CpuBatch {
  T* particle;
  T* aux;
  std::int64_t* id;
  int active;
};

/// The CPU side of the backend seam: one thread works on one block at a time, a vector register
/// holds one quantity of 8 (double) or 16 (float) particles, the arena lies in the thread's L1/L2.
///
/// Bodies see only these primitives (architecture page); the CUDA group offers the same ones with
/// one particle a thread. Grid values are gathered and scattered as quads {vector, mass}: all
/// quantities of a node in one register, one particle at a time; everything else is lanes =
/// particles, with register transposes between.
template <int D, class T, class Kernel>
class CpuGroup {
 public:
  using Real = T;
  using V = Lanes<T>;
  using Int = IntOf<V>;
  using Batch = CpuBatch<T>;
  using Shape = ArenaShape<Kernel, D>;
  static constexpr int dimension = D;
  static constexpr int width = lanes_of<V>;
  static constexpr int channels = 2;
  /// Numbers of arena memory a thread needs.
  static constexpr int arena_values = 2 * channels * Shape::values;

  CpuGroup(const PassData<D, T>& data, T* arena) : data_(data), arena_(arena) {}

  void begin(int block) {
    block_ = block;
    result_ = BlockResult<T>{};
    speed_ = signal_ = excursion_ = broadcast<V>(T(0));
  }

  /// Copies the grid's nodes around the block into the arena.
  void stage_in(int channel) {
    const T* grid = data_.read[channel];
    T* out = read_arena(channel);
    for (int n = 0; n < Shape::nodes; ++n) {
      const T* from = node(grid, n);
      if (from == nullptr) {
        std::memset(out + n * node_values, 0, node_values * sizeof(T));
      } else {
        std::memcpy(out + n * node_values, from, node_values * sizeof(T));
      }
    }
  }

  void clear(int channel) { std::memset(sum_arena(channel), 0, Shape::values * sizeof(T)); }
  void sync() {}

  /// Adds the arena's sums to the grid; blocks of one colour touch disjoint nodes.
  void stage_out(int channel) {
    T* grid = data_.write[channel];
    const T* sums = sum_arena(channel);
    for (int n = 0; n < Shape::nodes; ++n) {
      T* to = node(grid, n);
      if (to == nullptr) continue;
      for (int i = 0; i < node_values; ++i) to[i] += sums[n * node_values + i];
    }
  }

  template <class F>
  void each_batch(F&& f) {
    const int first = data_.batch_begin[block_];
    const int last = data_.batch_begin[block_ + 1];
    for (int i = first; i < last; ++i) {
      if (i + 1 < last) prefetch(data_.batch_list[i + 1]);
      f(batch(i, std::min(width, data_.counts[block_] - (i - first) * width)));
    }
  }

  V load(const Batch& b, int field) const { return scree::load<V>(b.particle + field * width); }
  void store(const Batch& b, int field, const V& x) { scree::store(b.particle + field * width, x); }
  V load_aux(const Batch& b, int field) const { return scree::load<V>(b.aux + field * width); }
  void store_aux(const Batch& b, int field, const V& x) { scree::store(b.aux + field * width, x); }

  MaskOf<V> active(const Batch& b) const { return first_lanes<V>(b.active); }
  T block_origin(int axis) const { return T(block_cells) * T(data_.coords[block_ * D + axis]); }

  /// value = sum w v, moment[c][a] = sum w v_c n_a, n = node number 0, 1, ... from the lowest.
  template <int S>
  void gather_moments(int channel, const Int& base, const V (&w)[D][S], V (&value)[D],
                      V (&moment)[D][D]) const {
    gather_impl<S, false>(channel, base, w, w, value, moment);
  }

  /// value = sum w v, gradient[c][a] = sum v_c dw/dx_a [per cell].
  template <int S>
  void gather_slopes(int channel, const Int& base, const V (&w)[D][S], const V (&slope)[D][S],
                     V (&value)[D], V (&gradient)[D][D]) const {
    gather_impl<S, true>(channel, base, w, slope, value, gradient);
  }

  /// Adds w (q + sum_a n_a m[.][a]) and mass w m to the nodes, for the lanes of `mask`.
  template <int S>
  void scatter_moments(int channel, const Int& base, const V (&w)[D][S], const V (&q)[D],
                       const V& mass, const V (&m)[D][D], const V& mask) {
    scatter_impl<S, false>(channel, base, w, w, q, mass, m, mask);
  }

  /// Adds w q + sum_a dw/dx_a g[.][a] and mass w m to the nodes, for the lanes of `mask`.
  template <int S>
  void scatter_slopes(int channel, const Int& base, const V (&w)[D][S], const V (&slope)[D][S],
                      const V (&q)[D], const V& mass, const V (&g)[D][D], const V& mask) {
    scatter_impl<S, true>(channel, base, w, slope, q, mass, g, mask);
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
    const V flag = select(mask, broadcast<V>(T(1)), broadcast<V>(T(0)));
    for (int l = 0; l < b.active; ++l) {
      if (lane(flag, l) == T(0)) continue;
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
    const V flag = select(mask, broadcast<V>(T(1)), broadcast<V>(T(0)));
    for (int l = 0; l < b.active; ++l) {
      if (lane(flag, l) == T(0)) continue;
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
  using IndexLane = Scalar<Int>;
  typedef T Quad __attribute__((vector_size(4 * sizeof(T)), may_alias));

  T* read_arena(int channel) const { return arena_ + channel * Shape::values; }
  T* sum_arena(int channel) const { return arena_ + (channels + channel) * Shape::values; }

  template <class P>
  P* node(P* grid, int n) const {
    static constexpr ArenaTable<Kernel, D> table;
    const NodePlace place = table.place[n];
    const std::int32_t block =
        data_.neighbours[data_.grid_block[block_] * neighbour_count<D> + place.neighbour];
    if (block < 0) return nullptr;
    const std::size_t stride = std::size_t(Kernel::lattices) * block_node_count<D> * node_values;
    return grid + block * stride + std::size_t(place.node) * node_values;
  }

  Batch batch(int i, int active) const {
    const std::size_t b = std::size_t(data_.batch_list[i]);
    return {data_.particles + b * data_.fields * width, data_.aux + b * data_.layout.total * width,
            data_.ids + b * width, active};
  }

  void prefetch(std::int32_t b) const {
    const T* p = data_.particles + std::size_t(b) * data_.fields * width;
    for (int f = 0; f < data_.fields; ++f) __builtin_prefetch(p + f * width, 1);
  }

  /// Writes a stencil to memory, so that single lanes can be read.
  template <int S, bool slopes>
  static void store_stencil(const Int& base, const V (&w)[D][S], const V (&alt)[D][S],
                            IndexLane (&bases)[width], T (&weights)[D][S][width],
                            T (&alts)[D][S][width]) {
    scree::store(bases, base);
    for (int a = 0; a < D; ++a) {
      for (int s = 0; s < S; ++s) {
        scree::store(&weights[a][s][0], w[a][s]);
        if constexpr (slopes) scree::store(&alts[a][s][0], alt[a][s]);
      }
    }
  }

  /// The weights of one lane; without slopes the second set is n w.
  template <int S, bool slopes>
  static void lane_weights(const T (&weights)[D][S][width], const T (&alts)[D][S][width], int l,
                           T (&w)[D][S], T (&alt)[D][S]) {
    for (int a = 0; a < D; ++a) {
      for (int s = 0; s < S; ++s) {
        w[a][s] = weights[a][s][l];
        alt[a][s] = slopes ? alts[a][s][l] : T(s) * w[a][s];
      }
    }
  }

  template <int S, bool slopes>
  void gather_impl(int channel, const Int& base, const V (&w)[D][S], const V (&alt)[D][S],
                   V (&value)[D], V (&moment)[D][D]) const {
    alignas(64) T weights[D][S][width];
    alignas(64) T alts[D][S][width];
    alignas(64) IndexLane bases[width];
    alignas(64) T records[width * LaneTranspose<T>::record];
    alignas(64) T lanes[LaneTranspose<T>::record * width];
    store_stencil<S, slopes>(base, w, alt, bases, weights, alts);
    for (int l = 0; l < width; ++l) {
      const Quad* nodes =
          reinterpret_cast<const Quad*>(read_arena(channel) + std::size_t(bases[l]) * node_values);
      T wl[D][S];
      T al[D][S];
      lane_weights<S, slopes>(weights, alts, l, wl, al);
      Quad sums[1 + D];
      gather_lane<S>(nodes, wl, al, sums);
      Quad* record = reinterpret_cast<Quad*>(records + l * LaneTranspose<T>::record);
      SCREE_UNROLL for (int q = 0; q <= D; ++q) record[q] = sums[q];
      if constexpr (D == 2) record[3] = Quad{};
    }
    LaneTranspose<T>::to_lanes(records, lanes);
    for (int c = 0; c < D; ++c) {
      value[c] = scree::load<V>(lanes + c * width);
      for (int a = 0; a < D; ++a) moment[c][a] = scree::load<V>(lanes + (4 * (a + 1) + c) * width);
    }
  }

  /// sums[0] = sum w q, sums[1 + a] = sum q with the weight of axis a replaced by alt.
  template <int S>
  static void gather_lane(const Quad* nodes, const T (&w)[D][S], const T (&alt)[D][S],
                          Quad (&sums)[1 + D]) {
    for (Quad& s : sums) s = Quad{};
    for (int i = 0; i < S; ++i) {
      if constexpr (D == 2) {
        Quad row{};
        Quad row_1{};
        gather_row<S>(nodes + i * Shape::extent, w[1], alt[1], row, row_1);
        sums[0] += w[0][i] * row;
        sums[1] += alt[0][i] * row;
        sums[2] += w[0][i] * row_1;
      } else {
        Quad plane{};
        Quad plane_1{};
        Quad plane_2{};
        for (int j = 0; j < S; ++j) {
          Quad row{};
          Quad row_2{};
          gather_row<S>(nodes + (i * Shape::extent + j) * Shape::extent, w[2], alt[2], row, row_2);
          plane += w[1][j] * row;
          plane_1 += alt[1][j] * row;
          plane_2 += w[1][j] * row_2;
        }
        sums[0] += w[0][i] * plane;
        sums[1] += alt[0][i] * plane;
        sums[2] += w[0][i] * plane_1;
        sums[3] += w[0][i] * plane_2;
      }
    }
  }

  template <int S>
  static void gather_row(const Quad* nodes, const T (&w)[S], const T (&alt)[S], Quad& sum,
                         Quad& other) {
    for (int k = 0; k < S; ++k) {
      sum += w[k] * nodes[k];
      other += alt[k] * nodes[k];
    }
  }

  template <int S, bool slopes>
  void scatter_impl(int channel, const Int& base, const V (&w)[D][S], const V (&alt)[D][S],
                    const V (&q)[D], const V& mass, const V (&m)[D][D], const V& mask) {
    alignas(64) T weights[D][S][width];
    alignas(64) T alts[D][S][width];
    alignas(64) IndexLane bases[width];
    alignas(64) T live[width];
    alignas(64) T lanes[LaneTranspose<T>::record * width];
    alignas(64) T records[width * LaneTranspose<T>::record];
    store_stencil<S, slopes>(base, w, alt, bases, weights, alts);
    scree::store(live, mask);
    const V none = broadcast<V>(T(0));
    SCREE_UNROLL for (int q_index = 0; q_index < 4; ++q_index) {
      SCREE_UNROLL for (int c = 0; c < 4; ++c) {
        T* out = lanes + (4 * q_index + c) * width;
        const bool used = q_index <= D && c < D;
        if (q_index == 0 && c == mass_slot) {
          scree::store(out, mass);
        } else if (!used) {
          scree::store(out, none);
        } else {
          scree::store(out, q_index == 0 ? q[c < D ? c : 0]
                                         : m[c < D ? c : 0][q_index > 0 ? q_index - 1 : 0]);
        }
      }
    }
    LaneTranspose<T>::to_records(lanes, records);
    for (int l = 0; l < width; ++l) {
      if (live[l] == T(0)) continue;
      Quad* nodes =
          reinterpret_cast<Quad*>(sum_arena(channel) + std::size_t(bases[l]) * node_values);
      T wl[D][S];
      T al[D][S];
      lane_weights<S, slopes>(weights, alts, l, wl, al);
      scatter_lane<S>(nodes, wl, al, reinterpret_cast<const Quad*>(records + l * 16));
    }
  }

  /// Node (i, j, k) += w_i w_j w_k q0 + alt_i w_j w_k q1 + w_i alt_j w_k q2 + w_i w_j alt_k q3.
  template <int S>
  static void scatter_lane(Quad* nodes, const T (&w)[D][S], const T (&alt)[D][S], const Quad* q) {
    for (int i = 0; i < S; ++i) {
      const Quad a = w[0][i] * q[0] + alt[0][i] * q[1];
      const Quad b = w[0][i] * q[2];
      if constexpr (D == 2) {
        Quad* row = nodes + i * Shape::extent;
        for (int j = 0; j < S; ++j) row[j] += w[1][j] * a + alt[1][j] * b;
      } else {
        const Quad c = w[0][i] * q[3];
        for (int j = 0; j < S; ++j) {
          Quad* row = nodes + (i * Shape::extent + j) * Shape::extent;
          const Quad ab = w[1][j] * a + alt[1][j] * b;
          const Quad cj = w[1][j] * c;
          for (int k = 0; k < S; ++k) row[k] += w[2][k] * ab + alt[2][k] * cj;
        }
      }
    }
  }

  const PassData<D, T>& data_;
  T* arena_;
  int block_ = 0;
  BlockResult<T> result_;
  V speed_;
  V signal_;
  V excursion_;
};

}  // namespace scree
