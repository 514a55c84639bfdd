// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "solver/base/tensor.hpp"
#include "solver/boundary/face_type.hpp"

/// The faces of the domain on the node lattices, for host and device code.
///
/// A wall at a multiple of dx maps each lattice on itself, so every ghost node beyond it has a
/// mirror node within, the "real" one. Let R be the reflection of a vector: diag(-1 normal,
/// +1 tangential). Slip and symmetry demand v_ghost = R v_real. Of all velocities that obey it, the
/// nearest to the free ones p/m in the norm of the masses is
///
///     min m1 |v - p1/m1|^2 + m2 |R v - p2/m2|^2   =>   v = (p1 + R p2) / (m1 + m2)
///
/// since R = R^T = R^-1: the ghost's mass and mirrored momentum fold onto the real node. Being a
/// projection it never adds energy, and it equals a computation with the mirror image of the body
/// beyond the wall. A node on the wall is its own mirror: v = R v, so v_n = 0 (sticky: v = 0).
///
/// separate and friction fold as slip does if the wall pushes. The pair's material then loses the
/// outward momentum J = (p1 + p2) . n - (m1 - m2) v . n = 2 (m2 p1 + m1 p2) . n / (m1 + m2), the
/// impulse on the wall; the wall pushes if J > 0. If J <= 0 both nodes move freely.
///
/// A uniform stress beside a wall pulls at the two nodes of a pair with one half of the traction
/// each. Walls that hold the material along them do so in one of two ways.
///
/// NoSlip::node: sticky stops the ghost's tangential velocity; the real node's is then p1/m1, again
/// the nearest. Friction takes at most mu J from the tangential momentum of the folded node. Such a
/// sticky wall bears half of a shear stress on this lattice, such a friction wall holds half a cell
/// within.
///
/// NoSlip::face: sticky folds with R = -1. The velocity is then odd and vanishes on the wall
/// between the nodes, and the wall bears the whole stress. Friction does the same if that takes a
/// tangential impulse S = 2 (m2 p1 + m1 p2)_t / (m1 + m2) of at most mu J. Else the wall slips:
/// each node loses the half of mu J S/|S|, and their tangential velocities stay their own. At |S| =
/// mu J both are the same, and as the energy falls all the way to S, friction adds none.
///
/// Where walls meet (edges, corners) a node has several ghosts: fold axis after axis on the nodes'
/// masses and momenta, in the order of fold_stage, then take v = p/m, then unfold in the reverse
/// order with mirror_velocity. For linear walls (slip, symmetry, sticky) this is the joint
/// projection on the constraints of all. All functions do nothing for open and periodic faces.
namespace scree {

/// What a node carries before v = p / m.
template <class T>
struct NodeMomentum {
  T mass;            ///< kg (2D: kg/m)
  Vec3<T> momentum;  ///< kg m/s, impulses of the step (stress, gravity, loads) included
};

/// Index of the mirror node in one axis. A lattice has its nodes at i dx (`half` = 0) or at
/// (i + 1/2) dx (`half` = 1); the wall is at `wall` dx. A node on the wall is its own mirror.
SCREE_FN std::int64_t mirror_index(std::int64_t i, std::int64_t wall, int half) {
  return 2 * wall - half - i;
}

/// Faces fold in stages, axis after axis in each. What depends on the velocities acts on those that
/// mirror planes and periodic faces have made whole: then it does not hang on the order of the
/// axes.
constexpr int fold_stages = 3;

SCREE_FN int fold_stage(FaceType type, NoSlip no_slip) {
  if (type == FaceType::sticky) return 2;
  const bool may_leave = type == FaceType::separate || type == FaceType::friction;
  return no_slip == NoSlip::face && may_leave ? 1 : 0;
}

/// Whether the velocity beyond a wall that folds is that within turned around, R = -1. (A friction
/// wall with NoSlip::face folds only where it holds.)
SCREE_FN bool turns_around(FaceType type, NoSlip no_slip) {
  return no_slip == NoSlip::face && (type == FaceType::sticky || type == FaceType::friction);
}

/// R v, for `axis` normal to the wall.
template <class T, int D>
SCREE_FN Vec3<T> mirror_velocity(FaceType type, NoSlip no_slip, int axis, const Vec3<T>& v) {
  const bool turned = turns_around(type, no_slip);
  Vec3<T> image = v;
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    image[a] = a == axis || turned ? -v[a] : type == FaceType::sticky ? T(0) : v[a];
  }
  return image;
}

/// p/m, or zero for a node without mass.
template <class T, int D>
SCREE_FN Vec3<T> node_velocity(const NodeMomentum<T>& node) {
  Vec3<T> v{};
  if (!(node.mass > 0)) return v;
  SCREE_UNROLL for (int a = 0; a < D; ++a) v[a] = node.momentum[a] / node.mass;
  return v;
}

/// Takes the friction impulse min(mu J, |p_t|) from the tangential momentum; returns that part.
template <class T, int D>
SCREE_FN Vec3<T> rub(T mu, int axis, T pushing, Vec3<T>& momentum) {
  Vec3<T> lost{};
  T square = 0;
  SCREE_UNROLL for (int a = 0; a < D; ++a) if (a != axis) square += momentum[a] * momentum[a];
  const T size = sqrt(square), most = mu * pushing;
  const T part = most < size ? most / size : T(1);
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    if (a == axis) continue;
    lost[a] = part * momentum[a];
    momentum[a] -= lost[a];
  }
  return lost;
}

/// Applies a wall to a node that lies on it. Returns the impulse on the wall, kg m/s.
/// \param outward +1 for a wall above the domain in `axis`, -1 for one below
template <class T, int D>
SCREE_FN Vec3<T> plane_node(FaceType type, T mu, int axis, int outward, NodeMomentum<T>& node) {
  Vec3<T> impulse{};
  if (type == FaceType::open || type == FaceType::periodic) return impulse;
  if (type == FaceType::sticky) {
    impulse = node.momentum;
    node.momentum = Vec3<T>{};
    return impulse;
  }
  const T pushing = T(outward) * node.momentum[axis];
  const bool may_leave = type == FaceType::separate || type == FaceType::friction;
  if (may_leave && !(pushing > 0)) return impulse;
  if (type == FaceType::friction) impulse = rub<T, D>(mu, axis, pushing, node.momentum);
  impulse[axis] = node.momentum[axis];
  node.momentum[axis] = 0;
  return impulse;
}

/// fold_pair for sticky and friction walls with NoSlip::face. Where friction slips, both nodes keep
/// their masses, and their normal velocities are mirrored.
template <class T, int D>
SCREE_FN Vec3<T> hold_or_slide(FaceType type, T mu, int axis, int outward, NodeMomentum<T>& real,
                               NodeMomentum<T>& ghost) {
  const T mass = real.mass + ghost.mass;
  Vec3<T> stop{};  // what it takes to stop the pair at the wall
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    stop[a] = 2 * (ghost.mass * real.momentum[a] + real.mass * ghost.momentum[a]) / mass;
  }
  Vec3<T> impulse = stop;
  bool slides = false;
  if (type == FaceType::friction) {
    const T pushing = T(outward) * stop[axis];
    if (!(pushing > 0)) return Vec3<T>{};
    impulse = rub<T, D>(mu, axis, pushing, stop);  // leaves in stop what friction cannot take
    impulse[axis] = stop[axis];
    SCREE_UNROLL for (int a = 0; a < D; ++a) slides = slides || (a != axis && stop[a] != T(0));
  }
  if (slides) {
    const T normal = (real.momentum[axis] - ghost.momentum[axis]) / mass;
    SCREE_UNROLL for (int a = 0; a < D; ++a) {
      real.momentum[a] = a == axis ? real.mass * normal : real.momentum[a] - impulse[a] / 2;
      ghost.momentum[a] = a == axis ? -ghost.mass * normal : ghost.momentum[a] - impulse[a] / 2;
    }
    return impulse;
  }
  SCREE_UNROLL for (int a = 0; a < D; ++a) real.momentum[a] -= ghost.momentum[a];
  real.mass = mass;
  ghost.mass = 0;
  ghost.momentum = Vec3<T>{};
  return impulse;
}

/// fold_pair for all other walls.
template <class T, int D>
SCREE_FN Vec3<T> mirror_or_stop(FaceType type, T mu, int axis, int outward, NodeMomentum<T>& real,
                                NodeMomentum<T>& ghost) {
  Vec3<T> impulse{};
  const T mass = real.mass + ghost.mass;
  const Vec3<T>& p = real.momentum;
  const Vec3<T>& q = ghost.momentum;
  impulse[axis] = 2 * (ghost.mass * p[axis] + real.mass * q[axis]) / mass;
  const T pushing = T(outward) * impulse[axis];
  const bool may_leave = type == FaceType::separate || type == FaceType::friction;
  if (may_leave && !(pushing > 0)) return Vec3<T>{};
  // A held wall leaves the real node's tangential velocity alone and stops the ghost's: written as
  // the momentum that gives p1/m1 with the folded mass.
  const T keep = type == FaceType::sticky && real.mass > 0 ? mass / real.mass : T(1);
  const Vec3<T> image = mirror_velocity<T, D>(type, NoSlip::node, axis, q);
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    if (a != axis) {
      if (type == FaceType::sticky) impulse[a] = q[a];
      real.momentum[a] *= keep;
    }
    real.momentum[a] += image[a];
  }
  if (type == FaceType::friction) {
    const Vec3<T> lost = rub<T, D>(mu, axis, pushing, real.momentum);
    SCREE_UNROLL for (int a = 0; a < D; ++a) if (a != axis) impulse[a] = lost[a];
  }
  real.mass = mass;
  ghost.mass = 0;
  ghost.momentum = Vec3<T>{};
  return impulse;
}

/// Applies a wall to a real node and its ghost. If the wall acts, the ghost's mass and momentum
/// move to the real node and the ghost is left with mass 0: its velocity is then
/// mirror_velocity(v_real). If not, both keep what they have. (A ghost without mass may be treated
/// either way: no particle sees it.) For a friction wall that slips, see hold_or_slide.
/// Returns the impulse on the wall, kg m/s: the momentum that the pair's material loses; its
/// component `axis` is 0 if a wall that may be left did not act. Where walls meet, later folds
/// change what the earlier ones left; there the impulse on all of them together is (momentum before
/// all folds) - (sum of m v after unfolding), which is the caller's to take.
template <class T, int D>
SCREE_FN Vec3<T> fold_pair(FaceType type, NoSlip no_slip, T mu, int axis, int outward,
                           NodeMomentum<T>& real, NodeMomentum<T>& ghost) {
  if (type == FaceType::open || type == FaceType::periodic) return Vec3<T>{};
  if (!(real.mass + ghost.mass > 0)) return Vec3<T>{};
  if (turns_around(type, no_slip)) {
    return hold_or_slide<T, D>(type, mu, axis, outward, real, ghost);
  }
  return mirror_or_stop<T, D>(type, mu, axis, outward, real, ghost);
}

}  // namespace scree
