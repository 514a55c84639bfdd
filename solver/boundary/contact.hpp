// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/tensor.hpp"
#include "solver/boundary/contact_type.hpp"

/// Contact of a grid node with a rigid surface, for host and device code.
namespace scree {

/// The velocity of a node after contact, m/s.
/// Coulomb's rule, with v_rel = v - v_object: if v_rel . n < 0 then
/// v_t <- v_t max(0, 1 - mu |v_n| / |v_t|), v_n <- 0, else unchanged. `separate` is mu = 0; `slip`
/// takes v_n away in both directions; `sticky` gives the object's velocity.
/// \param mu Coulomb's coefficient, >= 0; used with friction only
/// \param v velocity of the node, forces of the step included, m/s
/// \param object velocity of the surface, m/s
/// \param normal unit vector out of the object; only the first D components are used of all vectors
template <class T, int D>
SCREE_FN Vec3<T> contact_velocity(ContactType type, T mu, const Vec3<T>& v, const Vec3<T>& object,
                                  const Vec3<T>& normal) {
  if (type == ContactType::sticky) return object;
  T relative[D], approach = 0;
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    relative[a] = v[a] - object[a];
    approach += relative[a] * normal[a];
  }
  if (type != ContactType::slip && !(approach < 0)) return v;
  T tangential[D], square = 0;
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    tangential[a] = relative[a] - approach * normal[a];
    square += tangential[a] * tangential[a];
  }
  T keep = 1;
  if (type == ContactType::friction) {
    const T size = sqrt(square);
    const T lost = -mu * approach;
    keep = lost < size ? 1 - lost / size : T(0);
  }
  Vec3<T> result = v;
  SCREE_UNROLL for (int a = 0; a < D; ++a) result[a] = object[a] + keep * tangential[a];
  return result;
}

}  // namespace scree
