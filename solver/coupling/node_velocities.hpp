// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree {

/// Velocities of the nodes, by record, where the grid or another has them.
struct NodeVelocities {
  double* first = nullptr;
  std::size_t stride = 0;  ///< numbers from one node to the next

  /// The components of a node.
  double* operator[](std::int64_t record) const { return first + std::size_t(record) * stride; }
};

}  // namespace scree
