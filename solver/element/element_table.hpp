// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "solver/element/element_test.hpp"

namespace scree {

/// What every table of the driver begins with.
extern const char* const element_columns;

/// The table as CSV, with a header and a line a row: step, strains, p, q and stresses (compression
/// positive, Cauchy, Pa; tau_12 has the sign of strain_shear), void ratio, the law's output fields
/// (tensors by component: name_11, name_12, ...), and pore_pressure in triaxial_undrained and where
/// the material has pore water. Numbers read back to the same doubles.
std::string element_csv(const ElementResult& result);

}  // namespace scree
