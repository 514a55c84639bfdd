// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// What a face of the domain does to the material that meets it.
enum class FaceType {
  sticky,    ///< held: no velocity
  slip,      ///< no normal velocity, no friction, tension allowed
  separate,  ///< no penetration, no tension, no friction
  friction,  ///< no penetration, no tension, Coulomb friction
  open,      ///< particles leave and are removed
  periodic,  ///< what leaves here enters at the opposite face
  symmetry,  ///< the mirror plane of a symmetric problem; acts as slip
};

/// Where sticky faces, and friction faces that hold, stop the material along them.
enum class NoSlip {
  node,  ///< nodes beside the face; it bears a part of a shear stress (first order)
  face,  ///< the face itself; it bears the whole (second order)
};

}  // namespace scree
