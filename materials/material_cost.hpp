// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the point function of a law costs by itself: no transfer, no traffic of particles.
#pragma once

#include <any>
#include <string>

namespace scree {

/// Nanoseconds a particle of one call of kirchhoff() in SIMD lanes on this core, the best of some
/// repetitions over about `seconds`. Small states of random strain that stay in the cache; with
/// strains of 1e-3 to and fro, laws with a yield surface flow in part of the calls. Throws
/// UserError for a law that this build does not hold.
double material_cost(const std::string& model, const std::any& input, bool single_precision,
                     double seconds);

}  // namespace scree
