// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "materials/material_point.hpp"

namespace scree {

/// The point of a law of effective stresses with water in its pores that cannot drain
/// (materials/pore_water.hpp). Its stresses, energy and wave speed are those of soil and water; the
/// last of its entries is the pore pressure [Pa], zero at the start.
///
/// bulk_modulus: K_f/n [Pa], above 0; density: of the whole [kg/m^3].
std::unique_ptr<MaterialPoint> add_pore_water(std::unique_ptr<MaterialPoint> skeleton,
                                              double bulk_modulus, double density);

}  // namespace scree
