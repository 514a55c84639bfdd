// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/problems.hpp"
#include "solver/base/value.hpp"
#include "solver/deck/deck.hpp"
#include "solver/particles/sampling.hpp"
#include "solver/particles/surface.hpp"

namespace scree {

/// Reports what is wrong with [coupling], [drainage] and the pores of materials, as far as it can
/// be known without particles.
void check_coupling(const Deck& deck, const Value& document, Problems& problems);

/// The faces of a body on which a drainage acts at t = 0, without those that lie on another body.
std::vector<DrainedFace> drained_faces(const Deck& deck, const DrainageSpec& drainage,
                                       const SampledBody& body);

}  // namespace scree
