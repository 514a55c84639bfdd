// SPDX-License-Identifier: Apache-2.0
//
// A node and its ghost at a wall, for the tests of faces.
#pragma once

#include <random>

#include "solver/boundary/faces.hpp"

namespace scree::testing {

using Node = NodeMomentum<double>;
inline constexpr double rounding = 1e-14;  // masses and momenta of about 1

inline constexpr FaceType walls[] = {FaceType::sticky, FaceType::slip, FaceType::symmetry,
                                     FaceType::separate, FaceType::friction};
inline constexpr NoSlip rules[] = {NoSlip::node, NoSlip::face};

inline Node random_node(std::mt19937& random) {
  std::uniform_real_distribution<double> mass(0.01, 1), speed(-1, 1);
  Node node{mass(random), {}};
  for (int a = 0; a < 3; ++a) node.momentum[a] = node.mass * speed(random);
  return node;
}

inline double energy(double mass, const Vec3<double>& v) { return 0.5 * mass * dot(v, v); }

struct Outcome {
  Vec3<double> real, ghost, impulse;
  bool folded;
};

/// The velocities after one wall.
inline Outcome apply(FaceType type, double mu, int axis, int outward, Node real, Node ghost,
                     NoSlip rule = NoSlip::node) {
  Outcome result;
  result.impulse = fold_pair<double, 3>(type, rule, mu, axis, outward, real, ghost);
  result.folded = ghost.mass == 0;
  result.real = node_velocity<double, 3>(real);
  result.ghost = result.folded ? mirror_velocity<double, 3>(type, rule, axis, result.real)
                               : node_velocity<double, 3>(ghost);
  return result;
}

}  // namespace scree::testing
