// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/element/element_test.hpp"

namespace scree {

/// A direction of shear: principal values of a deviator, compression positive, of any size above 0.
/// It stands for a Lode angle, which is all that an isotropic law sees of it.
using ShearDirection = std::array<double, 3>;

inline constexpr ShearDirection triaxial_compression{2, -1, -1}, triaxial_extension{-2, 1, 1};

/// That of a state of stress; triaxial compression where its q is at most `negligible` [Pa].
ShearDirection shear_direction(const ElementRow& row, double negligible);

/// Mean pressures from `low` to `high` [Pa].
struct PressureRange {
  double low = 0, high = 0;
};

/// The yield surface of the state at the end of a test, in one direction of shear: points (p, q)
/// [Pa], Cauchy, q never negative, in the order of rising p, over those pressures of the range that
/// the elastic domain has. Empty where the law has no yield surface.
///
/// It is found with the law itself: from the unloaded state the point is compressed to each
/// pressure and sheared at constant volume until it yields first, so hardening has not moved the
/// surface yet. Rates vanish: of a law that knows them it is the surface of the slowest flow.
std::vector<std::pair<double, double>> yield_locus(const ElementResult& result,
                                                   const ShearDirection& direction,
                                                   PressureRange range);

}  // namespace scree
