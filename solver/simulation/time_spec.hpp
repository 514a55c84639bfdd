// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "solver/base/schema.hpp"

namespace scree {

/// `[time]`: how long and in which steps.
struct TimeSpec {
  double end = std::numeric_limits<double>::quiet_NaN();  ///< s
  double cfl = 0.4;            ///< fraction of the stable step's bound, (0, 0.5]
  std::optional<double> step;  ///< s; a fixed step in place of cfl
};

const Schema<TimeSpec>& time_schema();

}  // namespace scree
