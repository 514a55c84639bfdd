// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/j_fluid.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<JFluid::Input> sample_inputs<JFluid>() {
  return {{1e6, 7, 0, 1}, {1e6, 7, 3.0, 0.98}, {1e6, 1, 0.1, 1.01}, {2e5, 4.4, 0, 1}};
}

}  // namespace scree::testing
