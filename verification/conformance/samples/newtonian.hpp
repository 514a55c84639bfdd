// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/newtonian.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<Newtonian::Input> sample_inputs<Newtonian>() {
  return {{1e6, 0, 7, true}, {1e6, 3.0, 7, false}, {1e6, 0.1, 1, true}, {2e5, 0, 4.4, true}};
}

}  // namespace scree::testing
