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
/// beyond the wall. A node on the wall is its own mirror: v = R v, so v_n = 0.
///
/// sticky is the same with R = -1: the velocity is odd, so it vanishes on the wall between the
/// nodes. (Stopping the ghost alone and leaving the real node free would pass only half of a shear
/// stress to the wall: next to it a uniform stress pulls at the ghost and at the real node with one
/// half of the traction each.) A node on the wall rests.
///
/// separate and friction fold as slip does if the wall pushes. The pair's material then loses the
/// outward momentum J = (p1 + p2) . n - (m1 - m2) v . n = 2 (m2 p1 + m1 p2) . n / (m1 + m2), the
/// impulse on the wall, one half from each node; the wall pushes if J > 0. If J <= 0 both nodes
/// move freely.
///
/// friction holds as sticky does if that takes a tangential impulse S = 2 (m2 p1 + m1 p2)_t /
/// (m1 + m2) of at most mu J. Else the wall slips: each node loses the half of mu J S/|S|, and
/// their tangential velocities stay their own.
///
/// Where walls meet (edges, corners) a node has several ghosts: fold axis after axis on the nodes'
/// masses and momenta, then take v = p/m, then unfold the axes in the reverse order with
/// mirror_velocity. For slip and symmetry this is the joint projection on the constraints of all
/// walls. All functions do nothing for open and periodic faces.
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

/// R v, for `axis` normal to the wall. A friction wall folds only where it holds.
template <class T, int D>
SCREE_FN Vec3<T> mirror_velocity(FaceType type, int axis, const Vec3<T>& v) {
  Vec3<T> image = v;
  const bool held = type == FaceType::sticky || type == FaceType::friction;
  SCREE_UNROLL for (int a = 0; a < D; ++a) image[a] = a == axis || held ? -v[a] : v[a];
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

/// Takes half of the impulse from each node of a pair at a wall that slips: their normal velocities
/// are then mirrored, the tangential ones their own.
template <class T, int D>
SCREE_FN void slide_pair(int axis, const Vec3<T>& impulse, NodeMomentum<T>& real,
                         NodeMomentum<T>& ghost) {
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    real.momentum[a] -= impulse[a] / 2;
    ghost.momentum[a] -= impulse[a] / 2;
  }
  const T normal = (real.momentum[axis] - ghost.momentum[axis]) / (real.mass + ghost.mass);
  real.momentum[axis] = real.mass * normal;  // equal but for rounding
  ghost.momentum[axis] = -ghost.mass * normal;
}

/// Applies a wall to a real node and its ghost. If the wall acts, the ghost's mass and momentum
/// move to the real node and the ghost is left with mass 0: its velocity is then
/// mirror_velocity(v_real). If not, and where a friction wall slips, both keep what they have. (A
/// ghost without mass may be treated either way: no particle sees it.)
/// Returns the impulse on the wall, kg m/s: the momentum that the pair's material loses; its
/// component `axis` is 0 if the wall did not act. Where walls meet, later folds change what the
/// earlier ones left; there the impulse on all of them together is (momentum before all folds) -
/// (sum of m v after unfolding), which is the caller's to take.
template <class T, int D>
SCREE_FN Vec3<T> fold_pair(FaceType type, T mu, int axis, int outward, NodeMomentum<T>& real,
                           NodeMomentum<T>& ghost) {
  Vec3<T> impulse{};
  if (type == FaceType::open || type == FaceType::periodic) return impulse;
  const T mass = real.mass + ghost.mass;
  if (!(mass > 0)) return impulse;
  Vec3<T> stop{};  // what it takes to stop the pair at the wall
  SCREE_UNROLL for (int a = 0; a < D; ++a) stop[a] =
      2 * (ghost.mass * real.momentum[a] + real.mass * ghost.momentum[a]) / mass;
  const T pushing = T(outward) * stop[axis];
  const bool may_leave = type == FaceType::separate || type == FaceType::friction;
  if (may_leave && !(pushing > 0)) return impulse;
  impulse[axis] = stop[axis];
  if (type == FaceType::sticky) impulse = stop;
  if (type == FaceType::friction) {
    const Vec3<T> lost = rub<T, D>(mu, axis, pushing, stop);
    bool slips = false;
    SCREE_UNROLL for (int a = 0; a < D; ++a) {
      if (a == axis) continue;
      impulse[a] = lost[a];
      slips = slips || stop[a] != T(0);
    }
    if (slips) {
      slide_pair<T, D>(axis, impulse, real, ghost);
      return impulse;
    }
  }
  const Vec3<T> image = mirror_velocity<T, D>(type, axis, ghost.momentum);
  SCREE_UNROLL for (int a = 0; a < D; ++a) real.momentum[a] += image[a];
  real.mass = mass;
  ghost.mass = 0;
  ghost.momentum = Vec3<T>{};
  return impulse;
}

}  // namespace scree
