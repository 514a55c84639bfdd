// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/fixed_corotated.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<FixedCorotated::Input> sample_inputs<FixedCorotated>() {
  return {{1e7, 0.3}, {2e5, 0.45}, {1e7, 0.0}, {1e7, -0.4}};
}

}  // namespace scree::testing
