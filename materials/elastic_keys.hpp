// SPDX-License-Identifier: Apache-2.0
/// \file
/// The deck keys of isotropic elasticity, the same for every solid that has them.
#pragma once

#include "solver/base/schema.hpp"

namespace scree {

/// Declares youngs_modulus and poissons_ratio.
template <class Input>
void elastic_keys(Schema<Input>& s) {
  s.number("youngs_modulus", &Input::youngs_modulus, Unit::pressure)
      .typical(1e7)
      .above(0)
      .doc("Young's modulus at small strain.");
  s.number("poissons_ratio", &Input::poissons_ratio)
      .typical(0.3)
      .above(-1)
      .below(0.5)
      .doc("Poisson's ratio at small strain.");
}

}  // namespace scree
