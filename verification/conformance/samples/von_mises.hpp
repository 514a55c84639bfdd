// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/von_mises.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<VonMises::Input> sample_inputs<VonMises>() {
  return {{1e7, 0.3, 2e5, 0}, {1e7, 0.45, 1e5, 1e6}, {1e7, 0.0, 5e5, 2e4}};
}

}  // namespace scree::testing
