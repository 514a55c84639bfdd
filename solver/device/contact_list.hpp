// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/boundary/collider.hpp"
#include "solver/device/device_array.hpp"
#include "solver/device/kernels.hpp"
#include "solver/exec/thread_pool.hpp"
#include "solver/grid/grid.hpp"

namespace scree {

/// The nodes within colliders, on a device. The shapes are evaluated on the processor, so a node
/// touches where it does there: once for colliders at rest, each step while one moves.
template <int D, class T>
class ContactList {
 public:
  ContactList(Device& device, std::array<double, 3> lower, double cell_size);

  /// Must be called when the grid's blocks have changed.
  void forget() { known_ = false; }
  /// Brings the list and the colliders' motion up to date.
  void update(const Grid<D, T>& grid, const std::vector<Collider>& colliders, ThreadPool& pool);

  ContactNodes nodes() const;
  ContactSums sums() const;
  const ContactSurface* surfaces() const { return surfaces_.data(); }
  std::int64_t bytes() const;

 private:
  struct Contact {
    std::int64_t record;
    std::int32_t collider;
    std::array<double, 3> position;
    std::array<double, 3> normal;
  };
  bool has_moved(const std::vector<Collider>& colliders) const;
  void find(const Grid<D, T>& grid, int block, const std::vector<Collider>& colliders,
            std::vector<Contact>& out) const;
  void upload(const std::vector<std::vector<Contact>>& found, std::size_t colliders);

  std::array<double, 3> lower_;
  double cell_size_;
  bool known_ = false;
  std::vector<Vec3<double>> displacement_;  ///< of the colliders, when the list was made
  DeviceArray<std::int64_t> record_;
  DeviceArray<std::int32_t> begin_;
  DeviceArray<std::int32_t> collider_;
  DeviceArray<double> position_;
  DeviceArray<double> normal_;
  DeviceArray<double> impulse_;
  DeviceArray<std::int8_t> holds_;
  DeviceArray<double> settled_;
  DeviceArray<std::int32_t> sum_begin_;
  DeviceArray<std::int32_t> sum_list_;
  DeviceArray<ContactSurface> surfaces_;
};

extern template class ContactList<2, float>;
extern template class ContactList<2, double>;
extern template class ContactList<3, float>;
extern template class ContactList<3, double>;

}  // namespace scree
