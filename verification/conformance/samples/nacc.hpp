// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/nacc.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<Nacc::Input> sample_inputs<Nacc>() {
  return {{1e7, 0.3, -0.04, 0.5, 3, 1.2, 0}, {2e3, 0.39, -0.02, 0, 5, 0.8, 1e-3}};
}

}  // namespace scree::testing
