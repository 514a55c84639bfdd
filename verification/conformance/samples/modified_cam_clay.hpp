// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/modified_cam_clay.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<ModifiedCamClay::Input> sample_inputs<ModifiedCamClay>() {
  return {{1.2, 0.2, 0.05, 0.3, 2.0, 1e5, 4e5, {}},
          {1.02, 0.12, 0.023, 0.25, 1.7, 2e5, {}, 1.0},
          {0.9, 0.3, 0.06, 0.0, 3.0, 5e4, {}, 20.0}};
}

}  // namespace scree::testing
