// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/value.hpp"
#include "verification/suite/parameters.hpp"

namespace scree::verify {

/// One run of a case: a point of its sweep.
struct RunPlan {
  std::size_t series = 0;
  std::string series_name;
  double value = 0;       ///< of the swept parameter
  std::string label;      ///< "compact, 4 a direction, cells = 16"
  std::string slug;       ///< the label as a file name
  double size = 0;        ///< what errors of an order shrink with: dx, dt, ...
  bool may_fail = false;  ///< a baseline that may blow up
  Parameters parameters;
};

/// Runs of a case that differ in one parameter.
struct Series {
  std::string name, over;
  std::vector<double> ci, full;
  bool may_fail = false;
};

/// `[sweep]` of a case.toml: which runs a case consists of.
struct Sweep {
  std::string over;        ///< the parameter that series run over, unless they say otherwise
  std::string size_label;  ///< axis of convergence plots
  double seconds = 0;      ///< what the ci variant takes on one core
  std::vector<Series> series;
  std::vector<RunPlan> runs;  ///< of the variant that was asked for
};

/// Reads the sweep of a case's document and plans the runs of a variant. In all expressions the
/// parameter `full` is 0 or 1. Mistakes go to `problems`.
Sweep read_sweep(const Value& document, bool full, Problems& problems);

/// The document of a run as an ordinary deck: without `sweep`, braces filled.
Value deck_of(const Value& document, const Parameters& parameters, Problems& problems);

}  // namespace scree::verify
