// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace scree {

/// Nearest float; beyond its range infinity, chosen by comparison because the conversion itself
/// would raise an overflow, which debug builds trap.
inline float to_float(double value) {
  constexpr double limit = std::numeric_limits<float>::max();
  if (value > limit) return std::numeric_limits<float>::infinity();
  if (value < -limit) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(value);
}

}  // namespace scree
