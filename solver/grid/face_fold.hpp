// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/boundary/faces.hpp"
#include "solver/grid/block.hpp"

/// What the faces do to the records {momentum or velocity, mass} of one pair of nodes; see
/// boundary/faces.hpp. side: 0 = lower face, 1 = upper face.
namespace scree {

template <int D, class T>
SCREE_FN NodeMomentum<T> read_node(const T* record) {
  NodeMomentum<T> node{record[mass_slot], {}};
  for (int a = 0; a < D; ++a) node.momentum[a] = record[a];
  return node;
}

template <int D, class T>
SCREE_FN void write_node(T* record, const NodeMomentum<T>& node) {
  for (int a = 0; a < D; ++a) record[a] = node.momentum[a];
  record[mass_slot] = node.mass;
}

/// A node on a wall. `before` (may be null): its momentum before forces.
template <int D, class T>
SCREE_FN void hold_wall_node(FaceType type, T friction, int axis, int side, T* record, T* before) {
  NodeMomentum<T> node = read_node<D>(record);
  plane_node<T, D>(type, friction, axis, side == 0 ? -1 : 1, node);
  write_node<D>(record, node);
  if (before == nullptr) return;
  // So is the momentum before forces, or flip and local damping would see the wall's impulse.
  for (int a = 0; a < D; ++a) {
    const bool held = a == axis || type == FaceType::sticky;
    if (held && node.momentum[a] == T(0)) before[a] = T(0);
  }
}

/// What a fold left of a pair.
enum PairState : std::int8_t {
  pair_apart = 0,    ///< the wall did not act
  pair_follows = 1,  ///< the ghost's mass moved to the image, whose velocity it mirrors
  pair_slides = 2,   ///< only the normal velocities are mirrored
};

/// The momenta before forces of a pair that slides: their normal part is mirrored, too.
template <int D, class T>
SCREE_FN void mirror_normal(int axis, const T* image, const T* ghost, T* image_before,
                            T* ghost_before) {
  const T normal =
      (image_before[axis] - ghost_before[axis]) / (image[mass_slot] + ghost[mass_slot]);
  image_before[axis] = image[mass_slot] * normal;
  ghost_before[axis] = -ghost[mass_slot] * normal;
}

/// A ghost and its image. `before` of both (may be null): momenta before forces.
template <int D, class T>
SCREE_FN PairState fold_ghost(FaceType type, NoSlip no_slip, T friction, int axis, int side,
                              T* image, T* ghost, T* image_before, T* ghost_before) {
  NodeMomentum<T> real = read_node<D>(image);
  NodeMomentum<T> other = read_node<D>(ghost);
  const T own_mass = real.mass;
  const int outward = side == 0 ? -1 : 1;
  bool pushed = false;
  if (type == FaceType::periodic) {
    for (int a = 0; a < D; ++a) real.momentum[a] += other.momentum[a];
    real.mass += other.mass;
    other = NodeMomentum<T>{};
  } else if (turns_around(type, no_slip)) {
    pushed = fold_pair<T, D>(type, no_slip, friction, axis, outward, real, other)[axis] != T(0);
  } else {
    fold_pair<T, D>(type, no_slip, friction, axis, outward, real, other);
  }
  write_node<D>(image, real);
  write_node<D>(ghost, other);
  if (other.mass > 0) {
    if (!pushed) return pair_apart;
    if (image_before != nullptr) mirror_normal<D>(axis, image, ghost, image_before, ghost_before);
    return pair_slides;
  }
  if (image_before == nullptr) return pair_follows;
  // The momentum before forces follows in the same way, so that the velocity change is the pair's.
  Vec3<T> follows{};
  for (int a = 0; a < D; ++a) follows[a] = ghost_before[a];
  if (type != FaceType::periodic) follows = mirror_velocity<T, D>(type, no_slip, axis, follows);
  const bool grows = type == FaceType::sticky && !turns_around(type, no_slip) && own_mass > T(0);
  for (int a = 0; a < D; ++a) {
    T& own = image_before[a];
    if (grows && a != axis) own *= real.mass / own_mass;
    own += follows[a];
    ghost_before[a] = T(0);
  }
  return pair_follows;
}

/// The velocity of a ghost that follows its image.
template <int D, class T>
SCREE_FN void unfold_ghost(FaceType type, NoSlip no_slip, int axis, const T* image, T* ghost) {
  Vec3<T> v{};
  for (int a = 0; a < D; ++a) v[a] = image[a];
  if (type != FaceType::periodic) v = mirror_velocity<T, D>(type, no_slip, axis, v);
  for (int a = 0; a < D; ++a) ghost[a] = v[a];
}

/// Adds what lies beyond a periodic face to the image, momentum and mass.
template <class T>
SCREE_FN void move_to_image(T* image, T* ghost) {
  for (int i = 0; i < node_values; ++i) {
    image[i] += ghost[i];
    ghost[i] = T(0);
  }
}

}  // namespace scree
