// SPDX-License-Identifier: Apache-2.0
#include "solver/step/volume_passes.hpp"

#include "solver/step/volume_bodies.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {
namespace {

/// f(Kernel{}).
template <class F>
void with_kernel(KernelType kernel, F&& f) {
  switch (kernel) {
    case KernelType::compact:
      return f(Compact{});
    case KernelType::quadratic:
      return f(Quadratic{});
    case KernelType::linear:
      return f(Linear{});
  }
}

}  // namespace

template <int D, class T>
void run_volume_scatter(KernelType kernel, Executor& executor, const PassData<D, T>& data,
                        const VolumeFields& fields, const std::vector<std::int32_t>& blocks) {
  with_kernel(kernel, [&](auto k) {
    using Kernel = decltype(k);
    for_each_block<Kernel>(executor, data, blocks, [&](auto& group) {
      scatter_volumes_block<Kernel>(group, data, fields);
    });
  });
}

template <int D, class T>
void run_volume_gather(KernelType kernel, Executor& executor, const PassData<D, T>& data,
                       const VolumeFields& fields, const std::vector<std::int32_t>& blocks) {
  with_kernel(kernel, [&](auto k) {
    using Kernel = decltype(k);
    for_each_block<Kernel>(executor, data, blocks,
                           [&](auto& group) { gather_volumes_block<Kernel>(group, data, fields); });
  });
}

#define SCREE_VOLUMES(D, T)                                                                      \
  template void run_volume_scatter<D, T>(KernelType, Executor&, const PassData<D, T>&,           \
                                         const VolumeFields&, const std::vector<std::int32_t>&); \
  template void run_volume_gather<D, T>(KernelType, Executor&, const PassData<D, T>&,            \
                                        const VolumeFields&, const std::vector<std::int32_t>&);
SCREE_VOLUMES(2, float)
SCREE_VOLUMES(2, double)
SCREE_VOLUMES(3, float)
SCREE_VOLUMES(3, double)
#undef SCREE_VOLUMES

}  // namespace scree
