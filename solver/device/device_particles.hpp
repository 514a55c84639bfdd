// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/device/device_array.hpp"
#include "solver/device/kernels.hpp"
#include "solver/grid/topology.hpp"
#include "solver/particles/store.hpp"

namespace scree {

/// The particles of one body on a device, sorted by block: batches of 32, those of a block side by
/// side. Binning sorts all of them by the key of their block, so their order is a function of the
/// particles alone; a second set of pools takes them.
template <int D, class T>
class DeviceParticles {
 public:
  using Store = ParticleStore<D, T>;

  DeviceParticles(Device& device, DeviceKernels<D, T>& kernels);

  /// Takes all particles of a store, in its order.
  void take(const Store& store);
  /// Gives all particles to a store, in this order.
  void give(Store& store) const;
  /// Takes aux fields first .. first + count - 1 of a store that give() has filled.
  void take_aux(const Store& store, int first, int count);
  /// Changes the number of aux fields; their contents are lost.
  void resize_aux(int aux_fields);
  /// Moves strays to the block they are in and drops the dead. True if the set of blocks changed.
  bool bin(const std::array<std::int32_t, D>& wrap);
  /// Says which blocks of the grid the body's are.
  void find_grid_blocks(const Topology<D>& topology);

  /// Pointers for a pass; parameters, layout, neighbours and channels are the caller's to fill in.
  PassData<D, T> data() const;
  int blocks() const { return int(keys_.size()); }
  const std::vector<std::uint64_t>& keys() const { return keys_; }
  /// Of the block that a lane lies in.
  std::uint64_t key_of(std::int32_t lane) const;
  std::int64_t count() const { return count_; }
  std::int64_t bytes() const;

  /// Memory for `particles` in `blocks` blocks [bytes]; both sets of pools included.
  static std::int64_t needed_bytes(std::int64_t particles, std::int64_t blocks, int fields,
                                   int aux_fields);

 private:
  struct Pools {
    DeviceArray<T> particles;
    DeviceArray<T> aux;
    DeviceArray<std::int64_t> ids;
  };
  static constexpr int width = device_width;

  Pools make_pools() const;
  ParticlePools<T> view(const Pools& pools) const;
  void resize(Pools& pools, std::int64_t batches) const;
  void set_blocks(std::vector<std::uint64_t> keys, std::vector<std::int32_t> counts);
  std::int64_t batches() const { return batch_begin_.back(); }

  Device& device_;
  DeviceKernels<D, T>& kernels_;
  int fields_ = 0;
  int aux_fields_ = 0;
  Pools pools_;
  Pools spare_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::int32_t> counts_;
  std::vector<std::int32_t> batch_begin_{0};
  std::int64_t count_ = 0;
  DeviceArray<std::int32_t> counts_there_;
  DeviceArray<std::int32_t> batch_begin_there_;
  DeviceArray<std::int32_t> coords_;
  DeviceArray<std::int32_t> grid_block_;
  DeviceArray<BlockResult<T>> results_;
  DeviceArray<std::uint64_t> sort_keys_;
  DeviceArray<std::int32_t> order_;
  DeviceArray<std::int32_t> first_;
  DeviceArray<std::uint64_t> run_keys_;
  DeviceArray<std::int32_t> run_lengths_;
};

extern template class DeviceParticles<2, float>;
extern template class DeviceParticles<2, double>;
extern template class DeviceParticles<3, float>;
extern template class DeviceParticles<3, double>;

}  // namespace scree
