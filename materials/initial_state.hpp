// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "materials/material.hpp"
#include "materials/material_point.hpp"

namespace scree {

/// The state of a law that carries given normal stresses without having yielded: the entries in
/// the order of the law's fields, or nothing where the law has no such state (the stresses lie
/// outside the yield surface, or the law cannot carry them at all).
///
/// stress: xx, yy, zz [Pa], tension positive; the shear stresses are zero. It is the Kirchhoff
/// stress, force per area of the configuration that the law's volume ratio J refers to. Where the
/// law follows ln J as history (`log_volume_ratio`), that is the initial configuration itself: J =
/// 1, and the Cauchy stress is the same. Where J is det F, it is not, but a particle's reference
/// volume V0 times this stress is what balances its weight.
///
/// This is for laws without history in their stress; others know better (MaterialEntry::
/// state_under).
///
/// Accuracy: 1e-12 of the largest stress, or the rounding of the deformation gradient times the
/// law's stiffness. `point` must be in the law's initial state; its state is lost.
std::optional<std::vector<double>> initial_state(MaterialPoint& point,
                                                 const std::vector<StateField>& fields,
                                                 const std::array<double, 3>& stress);

}  // namespace scree
