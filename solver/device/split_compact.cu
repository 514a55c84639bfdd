// SPDX-License-Identifier: Apache-2.0
#include "solver/device/split.cuh"
#include "solver/transfer/compact.hpp"

namespace scree {
inline namespace SCREE_SIDE {

SCREE_SPLIT_LAUNCH(, Compact)

}  // namespace SCREE_SIDE
}  // namespace scree
