// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "postproc/plot/chart.hpp"
#include "solver/element/element_test.hpp"

namespace scree {

/// The diagrams of a test, at least two and at most four: stress against strain; the stress path
/// with the yield surface of the last state; volume (or pore pressure) against strain; void ratio
/// against ln p; stress ratio against strain. Of the last three those stay out that would say
/// nothing: of a constant or of values that are rounding.
///
/// Axisymmetric tests show q with the sign of sigma_1 - sigma_3, negative in extension, and the
/// yield surface on the sides where the path is; the others show it at the Lode angle of the end.
std::vector<Chart> element_charts(const ElementDeck& deck, const ElementResult& result);

}  // namespace scree
