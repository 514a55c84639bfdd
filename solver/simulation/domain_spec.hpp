// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "solver/base/schema.hpp"

namespace scree {

/// `[domain]`: the box that holds the grid.
struct DomainSpec {
  int dimension = 3;              ///< 2: plane strain, everything per metre of thickness; 3
  std::array<double, 3> lower{};  ///< m; third entry 0 in 2D
  std::array<double, 3> upper{};  ///< m; upper - lower is a multiple of cell_size
  double cell_size = std::numeric_limits<double>::quiet_NaN();  ///< m
  std::array<int, 3> cells{};  ///< cells an axis, from the above; third entry 1 in 2D
};

/// Cells between lower and upper in `axis`, rounded to the nearest whole number.
double cell_count(const DomainSpec& domain, int axis);

const Schema<DomainSpec>& domain_schema();

}  // namespace scree
