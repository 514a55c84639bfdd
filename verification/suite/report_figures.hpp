// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verification/suite/judge.hpp"

namespace scree::verify {

/// One picture of a report.
struct Picture {
  std::string title;
  std::string svg;
};

/// All pictures of a case: what its code shows (curves of each series' finest run over the
/// reference), then one convergence plot for each quantity that several sizes have, with the band
/// of the asserted order and the asserted bounds.
std::vector<Picture> pictures(const CaseResult& result);

}  // namespace scree::verify
