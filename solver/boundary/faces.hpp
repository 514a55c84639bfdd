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
/// sticky does the same with the normal velocity and stops the ghost's tangential one; the real
/// node's is then p1/m1, again the nearest. (An odd reflection of the tangential velocity too would
/// put the plane of no slip at the wall exactly, but shears the last half cell as a film: a column
/// of sand of aspect ratio 1.5 then ran out 2.34 instead of 2.15 widths; an independent code
/// has 2.11.)
///
/// separate and friction fold as slip does if the wall pushes. The pair's material then loses the
/// outward momentum J = (p1 + p2) . n - (m1 - m2) v . n = 2 (m2 p1 + m1 p2) . n / (m1 + m2), the
/// impulse on the wall; the wall pushes if J > 0. Friction takes at most mu J from the tangential
/// momentum. If J <= 0 both nodes move freely.
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

/// R v, for `axis` normal to the wall.
template <class T, int D>
SCREE_FN Vec3<T> mirror_velocity(FaceType type, int axis, const Vec3<T>& v) {
  Vec3<T> image = v;
  SCREE_UNROLL for (int a = 0; a < D; ++a) image[a] = a == axis                  ? -v[a]
                                                      : type == FaceType::sticky ? T(0)
                                                                                 : v[a];
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

/// Applies a wall to a real node and its ghost. If the wall acts, the ghost's mass and momentum
/// move to the real node and the ghost is left with mass 0: its velocity is then
/// mirror_velocity(v_real). If not, both keep what they have. (A ghost without mass may be treated
/// either way: no particle sees it.)
/// Returns the impulse on the wall, kg m/s: the momentum that the pair's material loses. Where
/// walls meet, later folds change what the earlier ones left; there the impulse on all of them
/// together is (momentum before all folds) - (sum of m v after unfolding), which is the caller's to
/// take.
template <class T, int D>
SCREE_FN Vec3<T> fold_pair(FaceType type, T mu, int axis, int outward, NodeMomentum<T>& real,
                           NodeMomentum<T>& ghost) {
  Vec3<T> impulse{};
  if (type == FaceType::open || type == FaceType::periodic) return impulse;
  const T mass = real.mass + ghost.mass;
  if (!(mass > 0)) return impulse;
  const Vec3<T>& p = real.momentum;
  const Vec3<T>& q = ghost.momentum;
  impulse[axis] = 2 * (ghost.mass * p[axis] + real.mass * q[axis]) / mass;
  const T pushing = T(outward) * impulse[axis];
  const bool may_leave = type == FaceType::separate || type == FaceType::friction;
  if (may_leave && !(pushing > 0)) return Vec3<T>{};
  // A held wall leaves the real node's tangential velocity alone and stops the ghost's: written as
  // the momentum that gives p1/m1 with the folded mass.
  const T keep = type == FaceType::sticky && real.mass > 0 ? mass / real.mass : T(1);
  const Vec3<T> image = mirror_velocity<T, D>(type, axis, q);
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

}  // namespace scree
