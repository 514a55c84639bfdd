// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "solver/element/element_test.hpp"

namespace scree {

/// The yield surface of the state at the end of a test, in triaxial compression: points (p, q)
/// [Pa], Cauchy, in the order of rising p, over the pressures of the test. Empty where the law has
/// no yield surface.
///
/// It is found with the law itself: from the unloaded state the point is compressed to each
/// pressure and sheared at constant volume until it yields first, so hardening has not moved the
/// surface yet.
std::vector<std::pair<double, double>> yield_locus(const ElementResult& result);

}  // namespace scree
