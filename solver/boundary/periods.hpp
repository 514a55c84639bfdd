// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace scree {

/// The axes in which a domain repeats itself, those between periodic faces.
struct Periods {
  std::array<double, 3> lower{};   ///< of the domain, m
  std::array<double, 3> length{};  ///< of the domain, m; 0 in axes that are not periodic

  bool any() const { return length[0] > 0 || length[1] > 0 || length[2] > 0; }
};

}  // namespace scree
