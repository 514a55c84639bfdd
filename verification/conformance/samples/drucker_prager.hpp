// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/drucker_prager.hpp"
#include "verification/conformance/samples.hpp"

namespace scree::testing {

template <>
inline std::vector<DruckerPrager::Input> sample_inputs<DruckerPrager>() {
  return {{1e7, 0.3, 30 * degree, 0, 0, Match::compression},
          {1e7, 0.2, 35 * degree, 2e4, 0, Match::plane_strain},
          {1e7, 0.3, 40 * degree, 5e4, 15 * degree, Match::plane_strain},
          {1e7, 0.0, 25 * degree, 1e4, 25 * degree, Match::extension},
          {1e7, 0.3, NAN, 1e4, 5 * degree, Match::compression, 0.6, 0.16, 0.2, 0.17}};
}

}  // namespace scree::testing
