// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace scree::verify {

/// The place that leaves 99.5 % of the particles behind it: single grains and spray are no front.
/// places: one a particle, at least one, in any order.
inline double front_of(std::vector<double> places) {
  const auto at = static_cast<std::size_t>(0.995 * static_cast<double>(places.size()));
  std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(at), places.end());
  return places[at];
}

}  // namespace scree::verify
