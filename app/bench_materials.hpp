// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// Prints what every law of this build costs by itself, ns a particle in double and in single
/// precision, with typical parameters; as one JSON object where `json`.
void print_material_costs(bool json);

}  // namespace scree
