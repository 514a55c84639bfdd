// SPDX-License-Identifier: Apache-2.0
#include "generated/materials.hpp"
#include "solver/device/kernels_of.cuh"
#include "solver/device/make_law.cuh"
#include "solver/device/open_device.cuh"
#include "solver/device/toolkits.hpp"

namespace scree {
inline namespace SCREE_SIDE {
namespace {

template <int D, class T>
struct Parts final : DeviceParts<D, T> {
  std::unique_ptr<DeviceKernels<D, T>> kernels() const override {
    return std::make_unique<KernelsOf<D, T>>();
  }
  std::unique_ptr<DeviceLaw<D, T>> law(const std::string& model, const std::any& input,
                                       double density) const override {
#define SCREE_MATERIAL(header, Type) \
  if (model == Type::name) return make_law<Type, D, T>(input, density);
#ifdef __CUDACC__
#include "generated/materials.def"
#else
#include "generated/emulated.def"
#endif
#undef SCREE_MATERIAL
    throw UserError("the material model \"" + model + "\" was not compiled for this device");
  }
};

struct Toolkit final : DeviceToolkit {
  using DeviceToolkit::DeviceToolkit;
  std::string name() const override {
#ifdef __CUDACC__
    return "cuda";
#else
    return "emulated";
#endif
  }
  std::unique_ptr<Device> open() const override { return open_device(); }
  const DeviceParts<2, float>& flat_single() const override { return flat_single_; }
  const DeviceParts<2, double>& flat_double() const override { return flat_double_; }
  const DeviceParts<3, float>& solid_single() const override { return solid_single_; }
  const DeviceParts<3, double>& solid_double() const override { return solid_double_; }

  Parts<2, float> flat_single_;
  Parts<2, double> flat_double_;
  Parts<3, float> solid_single_;
  Parts<3, double> solid_double_;
};

}  // namespace

}  // namespace SCREE_SIDE

std::shared_ptr<const DeviceToolkit> SCREE_SIDE::make_toolkit(MemoryNeedReport on_need) {
  return std::make_shared<SCREE_SIDE::Toolkit>(std::move(on_need));
}

}  // namespace scree
