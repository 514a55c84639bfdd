// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/mu_i.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<MuI::Input> sample_inputs<MuI>() {
  return {{1e7, 0.3, 0.382, 0.644, 0.279, 1e-3, 2650}, {1e6, 0.2, 0.5, 0.5, 0.3, 5e-3, 2500}};
}

}  // namespace scree::testing
