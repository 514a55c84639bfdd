// SPDX-License-Identifier: Apache-2.0
/// \file
/// Parameters of any law from its schema alone, for benchmarks and tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "materials/registry.hpp"

namespace scree {

/// Number keys of a model with their values in SI.
using NumberKeys = std::vector<std::pair<std::string, double>>;

/// Fills the Input of a law: `values`, else the typical value of the key, else its default. Throws
/// UserError where a key is required and has neither, or where the schema refuses the whole.
void set_typical_values(const SchemaBase& schema, void* input, int dimension,
                        const NumberKeys& values = {});

/// The same for a law of the registry; holds the law's Input.
std::any typical_input(const MaterialEntry& entry, int dimension, const NumberKeys& values = {});

}  // namespace scree
