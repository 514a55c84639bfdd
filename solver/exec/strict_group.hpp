// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "solver/exec/cpu_group.hpp"

namespace scree {

/// A batch that knows which visit it belongs to.
template <class T>
struct StrictBatch : CpuBatch<T> {
  int visit;
};

/// CpuGroup with the rules of a GPU: computes the same, but ends with std::logic_error where a body
/// would only work because one CPU thread does everything in order.
///
/// Every batch counts as another thread, and so does every arena node of stage_in, clear and
/// stage_out: what one writes, another may touch only after a sync. The arena is filled with
/// signalling NaN first, batches are visited in shuffled order (a function of the block's place and
/// number of batches, so results do not depend on threads), and indices and lane masks are checked.
/// Stamps are a channel's, not a node's, since stage_in, clear and stage_out touch all its nodes.
template <int D, class T, class Kernel>
class StrictGroup : private CpuGroup<D, T, Kernel> {
  using Base = CpuGroup<D, T, Kernel>;

 public:
  using typename Base::Int;
  using typename Base::Real;
  using typename Base::Shape;
  using typename Base::V;
  using Batch = StrictBatch<T>;
  static constexpr int max_set = 1;
  using Base::arena_values;
  using Base::block_origin;
  using Base::channels;
  using Base::dimension;
  using Base::expect;
  using Base::takes_pore_water;
  using Base::width;

  StrictGroup(const PassData<D, T>& data, T* arena) : Base(data, arena) {}

  void begin(int block) {
    Base::begin(block);
    for (int n = 0; n < neighbour_count<D>; ++n) {
      require(Base::around(block)[n] >= 0, "visits a block with a neighbour that holds no nodes");
    }
    epoch_ = 0;
    for (int c = 0; c < channels; ++c) {
      reads_[c] = {};
      sums_[c] = {};
    }
    const T poison = std::numeric_limits<T>::signaling_NaN();
    for (int i = 0; i < arena_values; ++i) std::memcpy(Base::arena_ + i, &poison, sizeof poison);
  }

  void stage_in(int channel) {
    between_batches("stage_in");
    Reads& reads = reads_[checked(channel)];
    require(data_.read[channel] != nullptr, "stages in a channel that the pass does not read");
    require(reads.gathered != epoch_, "a barrier is missing between gather and stage_in");
    reads.staged = epoch_;
    grids_apart();
    Base::stage_in(channel);
  }

  void clear(int channel) {
    between_batches("clear");
    Sums& sums = sums_[checked(channel)];
    require(sums.scattered != epoch_, "a barrier is missing between scatter and clear");
    require(sums.written != epoch_, "a barrier is missing between stage_out and clear");
    require(!sums.pending(), "clears sums that were not written to the grid");
    sums = {epoch_, never, never};
    Base::clear(channel);
  }

  void sync() {
    between_batches("sync");
    ++epoch_;
  }

  void stage_out(int channel) {
    between_batches("stage_out");
    Sums& sums = sums_[checked(channel)];
    require(data_.write[channel] != nullptr, "stages out a channel that the pass does not write");
    require(sums.cleared != never, "an uninitialised read: writes sums that were never cleared");
    require(sums.cleared != epoch_, "a barrier is missing between clear and stage_out");
    require(sums.scattered != epoch_, "a barrier is missing between scatter and stage_out");
    require(sums.written == never, "writes the same sums twice");
    sums.written = epoch_;
    grids_apart();
    Base::stage_out(channel);
  }

  template <class F>
  void each_batch(F&& f) {
    between_batches("each_batch");
    for (const int n : visiting_order()) {
      current_ = Batch{Base::batch(n), ++visit_};
      visiting_ = true;
      f(std::as_const(current_));
      visiting_ = false;
    }
  }

  template <int size, class F>
  void each_set(F&& f) {
    static_assert(size == max_set);
    each_batch([&](const Batch& b) { f(BatchSet<Batch, 1>{{b}, 1}); });
  }

  V load(const Batch& b, int field) const {
    valid(b);
    require_exists(field >= 0 && field < data_.fields, "reads particle field", field);
    return Base::load(b, field);
  }
  V load_again(const Batch& b, int field, const V&) const { return load(b, field); }
  void store(const Batch& b, int field, const V& x) {
    valid(b);
    require_exists(field >= 0 && field < data_.fields, "writes particle field", field);
    Base::store(b, field, x);
  }
  V load_aux(const Batch& b, int field) const {
    valid(b);
    require_exists(has_aux(field), "reads aux field", field);
    return Base::load_aux(b, field);
  }
  void store_aux(const Batch& b, int field, const V& x) {
    valid(b);
    require_exists(has_aux(field), "writes aux field", field);
    Base::store_aux(b, field, x);
  }

  MaskOf<V> active(const Batch& b) const {
    valid(b);
    return Base::active(b);
  }

  template <int S>
  void gather_moments(int channel, const Int& base, const V (&w)[D][S], V (&value)[D],
                      V (&moment)[D][D]) const {
    may_gather<S>(channel, base);
    Base::gather_moments(channel, base, w, value, moment);
  }
  template <int S>
  void gather_slopes(int channel, const Int& base, const V (&w)[D][S], const V (&slope)[D][S],
                     V (&value)[D], V (&gradient)[D][D]) const {
    may_gather<S>(channel, base);
    Base::gather_slopes(channel, base, w, slope, value, gradient);
  }
  template <int S>
  void scatter_moments(int channel, const Int& base, const V (&w)[D][S], const V (&q)[D],
                       const V& mass, const V (&m)[D][D], const V& mask) {
    may_scatter<S>(channel, base, mask);
    Base::scatter_moments(channel, base, w, q, mass, m, mask);
  }
  template <int S>
  void scatter_slopes(int channel, const Int& base, const V (&w)[D][S], const V (&slope)[D][S],
                      const V (&q)[D], const V& mass, const V (&g)[D][D], const V& mask) {
    may_scatter<S>(channel, base, mask);
    Base::scatter_slopes(channel, base, w, slope, q, mass, g, mask);
  }

  template <int L, int S>
  void gather_affine(int channel, const Stencil<V, D, L, S>& p, V (&velocity)[D],
                     V (&affine)[D][D]) const {
    for (int k = 0; k < L; ++k) may_gather<S>(channel, p.base[k]);
    Base::gather_affine(channel, p, velocity, affine);
  }
  template <int L, int S>
  void scatter_affine(int channel, const Stencil<V, D, L, S>& p, const V (&q)[D], const V& mass,
                      const V (&affine)[D][D], const V& mask) {
    for (int k = 0; k < L; ++k) may_scatter<S>(channel, p.base[k], mask);
    Base::scatter_affine(channel, p, q, mass, affine, mask);
  }

  void note_motion(const MaskOf<V>& mask, const V& speed, const V& excursion) {
    only_active(mask, "notes the motion of");
    Base::note_motion(mask, speed, excursion);
  }
  void note_signal(const MaskOf<V>& mask, const V& signal) {
    only_active(mask, "notes the wave speed of");
    Base::note_signal(mask, signal);
  }
  void fault(const MaskOf<V>& mask, FaultCode code, const V& value, const V (&u)[D],
             const Batch& b) {
    valid(b);
    only_active(mask, "reports a fault of");
    Base::fault(mask, code, value, u, b);
  }
  void remove(const MaskOf<V>& mask, const Batch& b) {
    valid(b);
    only_active(mask, "removes");
    Base::remove(mask, b);
  }

  void finish() {
    between_batches("finish");
    for (const Sums& sums : sums_) {
      require(!sums.pending(), "ends with sums that were not written to the grid");
    }
    Base::finish();
  }

 private:
  using Base::block_;
  using Base::data_;
  static constexpr int never = -1;

  /// Epochs (numbers of syncs before) in which a channel of velocities was last touched.
  struct Reads {
    int staged = never;
    int gathered = never;
  };
  /// The same for a channel of sums.
  struct Sums {
    int cleared = never;
    int scattered = never;
    int written = never;
    bool pending() const { return scattered != never && written == never; }
  };

  void require(bool holds, const char* defect) const {
    if (!holds) throw_defect(defect);
  }
  void require_exists(bool exists, const char* use, std::int64_t number) const {
    if (!exists) throw_defect(use + (" " + std::to_string(number)) + ", which does not exist");
  }
  [[noreturn]] void throw_defect(const std::string& defect) const {
    throw std::logic_error("block body, block " + std::to_string(block_) + ", epoch " +
                           std::to_string(epoch_) + ": " + defect);
  }

  int checked(int channel) const {
    require_exists(channel >= 0 && channel < channels, "uses channel", channel);
    return channel;
  }
  void between_batches(const char* primitive) const {
    if (visiting_) throw_defect(std::string(primitive) + " within each_batch: threads diverge");
  }
  void valid(const Batch& b) const {
    require(visiting_ && b.visit == visit_, "uses a batch outside its visit");
  }
  bool has_aux(int field) const {
    return data_.aux != nullptr && field >= 0 && field < data_.layout.total;
  }

  /// No pass may read a grid that another block writes at the same time.
  void grids_apart() const {
    for (int r = 0; r < channels; ++r) {
      for (int w = 0; w < channels; ++w) {
        require(reads_[r].staged == never || sums_[w].written == never ||
                    data_.read[r] != data_.write[w],
                "reads and writes the same grid channel in one pass");
      }
    }
  }

  template <int S>
  void may_gather(int channel, const Int& base) const {
    require(visiting_, "gathers outside each_batch");
    Reads& reads = reads_[checked(channel)];
    require(reads.staged != never, "an uninitialised read: gathers velocities never staged in");
    require(reads.staged != epoch_, "a barrier is missing between stage_in and gather");
    reads.gathered = epoch_;
    for (int l = 0; l < width; ++l) in_arena<S>(std::int64_t(lane(base, l)));
  }

  template <int S>
  void may_scatter(int channel, const Int& base, const V& mask) {
    require(visiting_, "scatters outside each_batch");
    Sums& sums = sums_[checked(channel)];
    require(sums.cleared != never, "an uninitialised read: scatters to sums never cleared");
    require(sums.cleared != epoch_, "a barrier is missing between clear and scatter");
    require(sums.written == never, "scatters to sums that were already written to the grid");
    sums.scattered = epoch_;
    for (int l = 0; l < width; ++l) {
      if (lane(mask, l) == T(0)) continue;
      require(lane(mask, l) == T(1), "scatters with a mask that is neither 0 nor 1");
      require(l < current_.active, "scatters a lane without a particle");
      require(current_.id[l] >= 0, "scatters a removed particle");
      in_arena<S>(std::int64_t(lane(base, l)));
    }
  }

  /// A stencil of S nodes an axis must not leave its lattice, nor wrap into the next row.
  template <int S>
  void in_arena(std::int64_t base) const {
    bool inside = base >= 0 && base < Shape::nodes;
    std::int64_t rest = inside ? base % Shape::lattice_nodes : 0;
    for (int a = 0; a < D; ++a) {
      inside = inside && rest % Shape::extent + S <= Shape::extent;
      rest /= Shape::extent;
    }
    require_exists(inside, "leaves the arena with the stencil at node", base);
  }

  void only_active(const MaskOf<V>& mask, const char* what) const {
    require(visiting_, "uses lanes outside each_batch");
    for (int l = current_.active; l < width; ++l) {
      if (lane(mask, l)) throw_defect(std::string(what) + " a lane without a particle");
    }
  }

  /// The block's batches, shuffled (Fisher, Yates).
  std::vector<int> visiting_order() const {
    std::vector<int> order(std::size_t(Base::batches()));
    std::iota(order.begin(), order.end(), 0);
    std::uint64_t state = order.size();
    for (int a = 0; a < D; ++a) {
      state = next(state ^ std::uint64_t(std::uint32_t(data_.coords[block_ * D + a])));
    }
    for (std::size_t n = order.size(); n > 1; --n) {
      state = next(state);
      std::swap(order[n - 1], order[std::size_t((state >> 33) % n)]);
    }
    return order;
  }
  /// Linear congruential generator, multiplier from Knuth, The Art of Computer Programming
  /// 2, 3.3.4.
  static std::uint64_t next(std::uint64_t state) {
    return state * 6364136223846793005u + 1442695040888963407u;
  }

  mutable Reads reads_[channels];
  Sums sums_[channels];
  int epoch_ = 0;
  int visit_ = 0;
  bool visiting_ = false;
  Batch current_{};
};

}  // namespace scree
