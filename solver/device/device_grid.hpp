// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/device/contact_list.hpp"
#include "solver/device/device_array.hpp"
#include "solver/device/face_lines.hpp"
#include "solver/device/kernels.hpp"
#include "solver/exec/thread_pool.hpp"
#include "solver/grid/grid_update.hpp"
#include "solver/simulation/backend.hpp"

namespace scree {

/// The grid of a run on a device. The set of blocks is worked out on the processor, from the sorted
/// keys of the blocks that hold particles: no table over the domain is needed.
template <int D, class T>
class DeviceGrid {
 public:
  DeviceGrid(Device& device, DeviceKernels<D, T>& kernels, const BackendConfig<D>& config);

  /// Finds the blocks anew, from those that hold particles (sorted). carry: `current` moves along.
  void rebuild(const std::vector<std::uint64_t>& occupied, bool carry);
  /// Zeroes a channel of the present blocks.
  void clear(DeviceArray<T>& channel);
  /// Zero sums in fixed point for the present blocks, with units for particles of mass m [kg] and a
  /// speed scale v [m/s].
  FixedChannels fixed_sums(double m, double v);
  /// Turns them into `current` (and `extra`).
  void take(const FixedChannels& sums);
  /// Momenta to velocities in `current` (and `extra`); *mass: mean mass of the lattices.
  /// reactions: 6 a collider, times step length and lattices.
  void update(const GridForces& forces, const std::vector<Collider>& colliders, ThreadPool& pool,
              double* mass, double* reactions);

  const Grid<D, T>& blocks() const { return grid_; }
  const std::int32_t* neighbours() const { return neighbours_.data(); }
  std::int64_t bytes() const;
  /// Memory of the channels and tables if these blocks hold particles (sorted) [bytes].
  std::int64_t needed_bytes(const std::vector<std::uint64_t>& occupied) const;

  DeviceArray<T> current;  ///< momenta, after update() velocities
  DeviceArray<T> next;     ///< fused: the grid scattered to
  DeviceArray<T> extra;    ///< channel 1: impulses, then velocity changes

 private:
  NodePass<T> node_pass(const GridForces& forces) const;
  FoldLines lines(int axis) const;
  bool folds(int axis, int stage) const;
  void fold(T* p, T* before);
  void unfold(T* p, T* q);
  void carry_over(const Topology<D>& before);

  Device& device_;
  DeviceKernels<D, T>& kernels_;
  BackendConfig<D> config_;
  Grid<D, T> grid_;
  std::vector<FaceLines> faces_;  ///< one an axis
  ContactList<D, T> contacts_;
  std::vector<DeviceArray<FixedChannels::Value>> fixed_;  ///< one a channel, where sums are fixed
  DeviceArray<std::int32_t> overflow_;
  DeviceArray<std::int32_t> neighbours_;
  DeviceArray<std::int32_t> from_block_;
  DeviceArray<double> block_mass_;
};

extern template class DeviceGrid<2, float>;
extern template class DeviceGrid<2, double>;
extern template class DeviceGrid<3, float>;
extern template class DeviceGrid<3, double>;

}  // namespace scree
