// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/device/device_array.hpp"
#include "solver/device/device_particles.hpp"
#include "solver/device/kernels.hpp"
#include "solver/simulation/backend.hpp"

namespace scree {

/// The few particles of one body on a device on which loads act. A step copies their values alone,
/// not those of all particles.
template <int D, class T>
class ChosenParticles {
 public:
  /// ids in ascending order; kernels must outlive it.
  ChosenParticles(Device& device, DeviceKernels<D, T>& kernels,
                  const std::vector<std::int64_t>& ids);

  /// Finds their lanes anew, after binning.
  void find(const DeviceParticles<D, T>& particles);
  /// Appends those that are still there.
  void read(const PassData<D, T>& data, int body, std::vector<LoadedParticle<D>>& out);
  /// Takes the accelerations of what read() has appended; returns what comes after it.
  const LoadedParticle<D>* write(const PassData<D, T>& data, const LoadedParticle<D>* from);
  std::int64_t bytes() const;

 private:
  static constexpr std::size_t row_values = 3 * D + D * D;

  ChosenRows<T> rows() const;

  DeviceKernels<D, T>& kernels_;
  std::vector<std::int64_t> ids_;
  std::vector<std::int32_t> lane_;             ///< -1: gone
  std::vector<std::array<double, D>> corner_;  ///< of its block [cells]
  std::vector<T> values_;
  DeviceArray<std::int64_t> ids_there_;
  DeviceArray<std::int32_t> lane_there_;
  DeviceArray<T> rows_there_;
};

extern template class ChosenParticles<2, float>;
extern template class ChosenParticles<2, double>;
extern template class ChosenParticles<3, float>;
extern template class ChosenParticles<3, double>;

}  // namespace scree
