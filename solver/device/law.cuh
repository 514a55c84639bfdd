// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <memory>

#include "solver/device/make_law.cuh"
#include "solver/step/cuda_kernels.cuh"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {
inline namespace SCREE_SIDE {

/// The passes with code of one law.
template <class Material, int D, class T>
class LawOf final : public DeviceLaw<D, T> {
 public:
  using Params = typename Material::template Params<T>;

  LawOf(const typename Material::Input& input, double density)
      : params_(Material::template params<T>(input, density, D)) {}

  void g2p2g(KernelType kernel, const PassData<D, T>& data, int blocks) const override {
    const auto pass = kernel == KernelType::compact ? kernels::g2p2g<Compact, Material, D, T>
                                                    : kernels::g2p2g<Quadratic, Material, D, T>;
    launch("g2p2g", pass, blocks, block_threads, data, params_);
  }
  void stress(const PassData<D, T>& data, int blocks) const override {
    launch("stress", kernels::stress<Material, Compact, D, T>, blocks, block_threads, data,
           params_);
  }

 private:
  Params params_;
};

template <class Material, int D, class T>
std::unique_ptr<DeviceLaw<D, T>> make_law(const std::any& input, double density) {
  const auto& values = std::any_cast<const typename Material::Input&>(input);
  return std::make_unique<LawOf<Material, D, T>>(values, density);
}

}  // namespace SCREE_SIDE
}  // namespace scree

/// Compiles one law for one dimension and precision; one translation unit each, written by CMake.
#define SCREE_INSTANTIATE_LAW(Type, D, real)                                                     \
  namespace scree {                                                                              \
  inline namespace SCREE_SIDE {                                                                  \
  template std::unique_ptr<DeviceLaw<D, real>> make_law<Type, D, real>(const std::any&, double); \
  }                                                                                              \
  }
