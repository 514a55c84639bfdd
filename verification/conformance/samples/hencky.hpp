// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/hencky.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<Hencky::Input> sample_inputs<Hencky>() {
  return {{1e7, 0.3}, {2e5, 0.45}, {1e7, -0.4}};
}

}  // namespace scree::testing
