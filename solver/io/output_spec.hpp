// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/schema.hpp"

namespace scree {

enum class FrameFormat { vtu, xdmf, none };
enum class FramePrecision { single_, double_ };
enum class FrameCompression { none, deflate };

/// `[output]`: frames of particles and grid. The first is t = 0, the last time.end.
struct OutputSpec {
  double every = std::numeric_limits<double>::quiet_NaN();  ///< s; default time.end
  FrameFormat format = FrameFormat::vtu;
  FramePrecision precision = FramePrecision::single_;
  FrameCompression compression = FrameCompression::none;  ///< xdmf only
  std::vector<std::string> fields;                        ///< besides id, material and body
  bool grid = false;
};

/// `[history]`: rows of history.csv.
struct HistorySpec {
  double every = std::numeric_limits<double>::quiet_NaN();  ///< s; default output.every
};

/// `[checkpoint]`
struct CheckpointSpec {
  std::optional<double> every;  ///< s; none: only at signals and limits
};

const Schema<OutputSpec>& output_schema();
const Schema<HistorySpec>& history_schema();
const Schema<CheckpointSpec>& checkpoint_schema();

}  // namespace scree
