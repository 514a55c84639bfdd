// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/mohr_coulomb.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<MohrCoulomb::Input> sample_inputs<MohrCoulomb>() {
  return {{1e7, 0.3, 30 * degree, 0, 0},
          {1e7, 0.2, 38 * degree, 2e4, 8 * degree, 1e4},
          {1e7, 0.0, 25 * degree, 1e4, 25 * degree},
          {1e7, 0.45, 0, 5e4, 0},
          {1e7, 0.3, 40 * degree, 2e4, 10 * degree, 5e3, 30 * degree, 1e4, 4 * degree, 0.1}};
}

}  // namespace scree::testing
