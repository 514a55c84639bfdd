// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/simulation/particle_fields.hpp"
#include "solver/simulation/particle_view.hpp"
#include "solver/step/body.hpp"

namespace scree {

/// Where the components of a 3x3 tensor, row-major, lie among xx, xy, xz, yy, yz, zz. Viewers order
/// six components otherwise, so all tensors go out whole.
inline constexpr int sym_index[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};

/// Writes the value of a field of one particle. `reference`: its position at t = 0 (displacement).
/// What needs more than the view (strain rate, what the material keeps) is left alone, and so is
/// what there is not: NaN stays.
void write_quantity(FieldQuantity quantity, const ParticleView& particle, const BodyInfo& info,
                    const double* reference, double* out);

}  // namespace scree
