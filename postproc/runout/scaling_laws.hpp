// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace scree {

/// The collapse of a dry column of width (radius) d0 and height h0 = a d0, as experiments found it:
/// the final run-out (d - d0)/d0 and the final height h/d0. Published scatter: about 10 %.
struct ScalingLaw {
  std::string name;   ///< for people
  double runout = 0;  ///< (d - d0)/d0
  double height = 0;  ///< h/d0 at the wall or axis
};

/// Lube, Huppert, Sparks & Freundt: columns between walls, Phys. Rev. E 72, 041301 (2005);
/// round ones (axisymmetric), J. Fluid Mech. 508, 175 (2004). `a` > 0.
ScalingLaw lube(double a, bool axisymmetric);

/// Lajeunesse, Monnier & Homsy, Phys. Fluids 17, 103302 (2005). `a` > 0.
ScalingLaw lajeunesse(double a, bool axisymmetric);

/// The time that a collapse takes in both, 3.3 sqrt(h0/g) [s].
double collapse_time(double height, double gravity);

}  // namespace scree
