// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/problems.hpp"
#include "solver/base/value.hpp"
#include "solver/deck/deck.hpp"

namespace scree {

/// Checks across tables: references, places of bodies, fields, names. A check whose keys already
/// have a problem is left out. `document` gives the positions.
void check_deck(const Deck& deck, const Value& document, Problems& problems);

}  // namespace scree
