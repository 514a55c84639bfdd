// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace scree {

/// What a column of history.csv holds: columns of one kind share a diagram.
struct HistoryKind {
  std::string title;  ///< "Energy"; of its axis
  std::string unit;   ///< SI; in 2D per metre of thickness; "" where it has none
};

/// \param colliders names of the run's colliders, whose columns begin with them
HistoryKind history_kind(const std::string& column, const std::vector<std::string>& colliders,
                         int dimension);

}  // namespace scree
