// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// What a rigid surface does to the material that meets it.
enum class ContactType {
  sticky,    ///< the material takes the surface's velocity
  slip,      ///< no relative normal velocity, tension allowed, no friction
  separate,  ///< no penetration, no tension, no friction
  friction,  ///< no penetration, no tension, Coulomb friction
};

}  // namespace scree
