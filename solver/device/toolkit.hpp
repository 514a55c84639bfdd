// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "solver/device/device.hpp"
#include "solver/device/kernels.hpp"
#include "solver/device/memory_need.hpp"

namespace scree {

/// Kernels and laws of one dimension and precision.
template <int D, class T>
class DeviceParts {
 public:
  virtual ~DeviceParts() = default;
  virtual std::unique_ptr<DeviceKernels<D, T>> kernels() const = 0;
  /// Throws UserError for a law that was not compiled for the device. input: the law's Input.
  virtual std::unique_ptr<DeviceLaw<D, T>> law(const std::string& model, const std::any& input,
                                               double density) const = 0;
};

/// All that a run needs of a kind of device.
class DeviceToolkit {
 public:
  /// on_need: told the need before it is allocated; may be empty.
  explicit DeviceToolkit(MemoryNeedReport on_need) : on_need_(std::move(on_need)) {}
  virtual ~DeviceToolkit() = default;
  virtual std::string name() const = 0;  ///< cuda, emulated
  virtual std::unique_ptr<Device> open() const = 0;
  void tell(const MemoryNeed& need) const {
    if (on_need_) on_need_(need);
  }

  template <int D, class T>
  const DeviceParts<D, T>& parts() const {
    constexpr bool single = std::is_same_v<T, float>;
    if constexpr (D == 2 && single) return flat_single();
    if constexpr (D == 2 && !single) return flat_double();
    if constexpr (D == 3 && single) return solid_single();
    if constexpr (D == 3 && !single) return solid_double();
  }

 protected:
  virtual const DeviceParts<2, float>& flat_single() const = 0;
  virtual const DeviceParts<2, double>& flat_double() const = 0;
  virtual const DeviceParts<3, float>& solid_single() const = 0;
  virtual const DeviceParts<3, double>& solid_double() const = 0;

 private:
  MemoryNeedReport on_need_;
};

}  // namespace scree
