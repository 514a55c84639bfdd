// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "solver/base/config.hpp"
#include "solver/device/device.hpp"

namespace scree {

/// First entry of a lane in a pool of `fields` fields on a device; the next field is device_width
/// entries on. (Lane: 32 bits where they hold all lanes, for wider ones take registers.)
template <class Lane>
SCREE_FN std::int64_t pool_entry(Lane lane, int fields) {
  return std::int64_t(lane / device_width) * fields * device_width + lane % device_width;
}

}  // namespace scree
