// SPDX-License-Identifier: Apache-2.0
#include "solver/device/split.cuh"
#include "solver/transfer/linear.hpp"

namespace scree {
inline namespace SCREE_SIDE {

SCREE_SPLIT_LAUNCH(, Linear)

}  // namespace SCREE_SIDE
}  // namespace scree
