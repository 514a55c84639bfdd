// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "solver/base/tensor.hpp"

/// Answers of colliders whose shapes are slow to ask (meshes). The signed distance changes by at
/// most the length that the collider has moved since, so a node far enough away needs no new
/// question, and one of a collider at rest never does. What is answered does not depend on what is
/// remembered.
namespace scree {

/// One node and one collider.
struct ContactMemory {
  double distance = -std::numeric_limits<double>::infinity();  ///< signed, m
  double travelled = -1;  ///< the collider's way when it was asked, m; below 0: never
  Vec3<double> normal{};  ///< where it touched
};

/// One block of nodes and one collider.
struct BlockContactMemory {
  ContactMemory center;              ///< of the block
  std::vector<ContactMemory> nodes;  ///< of all lattices; empty: not near yet
  bool near = true;                  ///< in this step
};

}  // namespace scree
