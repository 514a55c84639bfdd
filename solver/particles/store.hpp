// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/exec/aligned.hpp"
#include "solver/exec/thread_pool.hpp"
#include "solver/grid/block.hpp"

namespace scree {

/// Particles of one body in batches of one 64-byte vector a field (8 doubles, 16 floats), binned by
/// block.
///
/// A batch holds `fields` vectors one after the other (AoSoA): the position (D entries, in cells
/// from the lower corner of the particle's block, so that precision does not depend on the domain's
/// size), then the material's state. A second pool of the same shape holds `aux` fields (velocity,
/// affine matrix, stress, ...) where the method needs them. Lanes past a block's count are padding:
/// they hold a resting, undeformed particle and never reach the grid.
template <int D, class T>
class ParticleStore {
 public:
  static constexpr int width = 64 / sizeof(T);

  /// padding: one value for each field of a resting particle (position fields are ignored).
  ParticleStore(int fields, int aux, std::vector<T> padding);

  struct Block {
    std::uint64_t key = 0;
    std::int32_t count = 0;
    std::vector<std::int32_t> batches;
  };

  /// Makes room for this many lanes without moving memory again (growth is by an eighth otherwise).
  void reserve(std::int64_t particles);
  /// Appends a particle to the block `key`; returns its slot (batch * width + lane).
  std::int64_t append(std::uint64_t key, std::int64_t id);
  /// Drops all particles.
  void clear();
  /// Moves strays to the block they are in now and drops dead particles (id -1).
  ///
  /// wrap[a] > 0: axis a is periodic with this many cells. Returns true if the set of blocks
  /// changed. The order is a function of the particles alone, not of threads.
  bool rebin(const std::array<std::int32_t, D>& wrap, ThreadPool& pool);
  /// Sorts blocks by key and rebuilds the flat lists below; needed after append().
  void finish_blocks();
  /// Changes the number of aux fields; their contents are lost.
  void resize_aux(int aux);

  /// Batches that there is memory for: slots are less than batches() times width.
  std::int64_t batches() const { return std::int64_t(ids_.size()) / width; }
  int fields() const { return fields_; }
  int aux_fields() const { return aux_; }
  std::int64_t count() const { return count_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  /// First entry of each block in batch_list(); size blocks + 1.
  const std::vector<std::int32_t>& batch_begin() const { return batch_begin_; }
  const std::vector<std::int32_t>& batch_list() const { return batch_list_; }
  const std::vector<std::int32_t>& counts() const { return counts_; }

  T* batch(std::int32_t b) { return pool_.data() + std::size_t(b) * fields_ * width; }
  const T* batch(std::int32_t b) const { return pool_.data() + std::size_t(b) * fields_ * width; }
  T* aux_batch(std::int32_t b) { return aux_pool_.data() + std::size_t(b) * aux_ * width; }
  const T* aux_batch(std::int32_t b) const {
    return aux_pool_.data() + std::size_t(b) * aux_ * width;
  }
  std::int64_t* ids(std::int32_t b) { return ids_.data() + std::size_t(b) * width; }
  const std::int64_t* ids(std::int32_t b) const { return ids_.data() + std::size_t(b) * width; }

  T& value(std::int64_t slot, int field) {
    return batch(int(slot / width))[field * width + slot % width];
  }
  T& aux_value(std::int64_t slot, int field) {
    return aux_batch(int(slot / width))[field * width + slot % width];
  }

  std::int64_t bytes() const;

 private:
  /// What some blocks that follow each other give away.
  struct Outbox {
    std::vector<std::uint64_t> key;
    std::vector<std::int64_t> id;
    std::vector<T> record;            ///< fields + aux of each stray
    std::vector<std::int32_t> freed;  ///< batches
    std::int64_t removed = 0;         ///< particles, strays and dead ones
  };

  std::int32_t take_batch();
  void fill_padding(std::int32_t b, int lane);
  void copy_slot(std::int64_t from, std::int64_t to);
  std::size_t find_or_add(std::uint64_t key);
  void collect(Block& block, const std::array<std::int32_t, D>& wrap, Outbox& outbox);
  void remove_slot(Block& block, std::int32_t index, Outbox& outbox);
  void deliver(const Outbox& outbox);
  std::int64_t slot(const Block& block, std::int32_t index) const {
    return std::int64_t(block.batches[index / width]) * width + index % width;
  }

  int fields_;
  int aux_;
  std::vector<T> padding_;
  AlignedVector<T> pool_;
  AlignedVector<T> aux_pool_;
  std::vector<std::int64_t> ids_;
  std::vector<std::int32_t> free_;
  std::vector<Block> blocks_;
  std::size_t sorted_ = 0;  ///< blocks_[0 .. sorted_) are sorted by key
  std::int64_t count_ = 0;
  std::vector<std::int32_t> batch_begin_;
  std::vector<std::int32_t> batch_list_;
  std::vector<std::int32_t> counts_;
};

extern template class ParticleStore<2, float>;
extern template class ParticleStore<2, double>;
extern template class ParticleStore<3, float>;
extern template class ParticleStore<3, double>;

}  // namespace scree
