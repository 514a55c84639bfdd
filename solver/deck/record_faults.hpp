// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/deck/deck.hpp"

namespace scree {

/// A place in the deck at which nothing can be recorded.
struct RecordFault {
  std::vector<std::string> path;  ///< of the key, e.g. {"probe", "toe", "at"}
  std::string message, allowed, repair;
};

/// Probes, profiles, sections and regions that lie wholly outside of the domain, whose files would
/// hold nothing. Keys that have a problem already are left out.
std::vector<RecordFault> record_faults(const Deck& deck, const Problems& problems);

}  // namespace scree
