// SPDX-License-Identifier: Apache-2.0
#include "solver/step/split_passes.hpp"

#include "solver/step/split_kernel.hpp"

namespace scree {

#define SCREE_EXTERN(Kernel)                             \
  extern template struct SplitKernel<Kernel, 2, float>;  \
  extern template struct SplitKernel<Kernel, 2, double>; \
  extern template struct SplitKernel<Kernel, 3, float>;  \
  extern template struct SplitKernel<Kernel, 3, double>;
SCREE_EXTERN(Compact)
SCREE_EXTERN(Quadratic)
SCREE_EXTERN(Linear)
#undef SCREE_EXTERN

template <int D, class T>
void run_p2g(KernelType kernel, TransferType transfer, Executor& executor,
             const PassData<D, T>& data, const std::vector<std::int32_t>& blocks) {
  switch (kernel) {
    case KernelType::compact:
      return SplitKernel<Compact, D, T>::p2g(transfer, executor, data, blocks);
    case KernelType::quadratic:
      return SplitKernel<Quadratic, D, T>::p2g(transfer, executor, data, blocks);
    case KernelType::linear:
      return SplitKernel<Linear, D, T>::p2g(transfer, executor, data, blocks);
  }
}

template <int D, class T>
void run_g2p(KernelType kernel, TransferType transfer, Executor& executor,
             const PassData<D, T>& data, const std::vector<std::int32_t>& blocks) {
  switch (kernel) {
    case KernelType::compact:
      return SplitKernel<Compact, D, T>::g2p(transfer, executor, data, blocks);
    case KernelType::quadratic:
      return SplitKernel<Quadratic, D, T>::g2p(transfer, executor, data, blocks);
    case KernelType::linear:
      return SplitKernel<Linear, D, T>::g2p(transfer, executor, data, blocks);
  }
}

#define SCREE_SPLIT(D, T)                                                                 \
  template void run_p2g<D, T>(KernelType, TransferType, Executor&, const PassData<D, T>&, \
                              const std::vector<std::int32_t>&);                          \
  template void run_g2p<D, T>(KernelType, TransferType, Executor&, const PassData<D, T>&, \
                              const std::vector<std::int32_t>&);
SCREE_SPLIT(2, float)
SCREE_SPLIT(2, double)
SCREE_SPLIT(3, float)
SCREE_SPLIT(3, double)
#undef SCREE_SPLIT

}  // namespace scree
