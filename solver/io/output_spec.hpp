// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/schema.hpp"
#include "solver/particles/shape_spec.hpp"

namespace scree {

enum class FrameFormat { vtu, xdmf, none };
enum class FramePrecision { single_, double_ };
enum class FrameCompression { none, deflate };

/// `[output]`: frames of particles and grid. The first is t = 0, the last time.end. The same for a
/// further series, `[frames.NAME]`.
struct OutputSpec {
  std::string name = "particles";                           ///< of the series' files
  double every = std::numeric_limits<double>::quiet_NaN();  ///< s; default time.end
  FrameFormat format = FrameFormat::vtu;
  FramePrecision precision = FramePrecision::single_;
  FrameCompression compression = FrameCompression::none;  ///< xdmf only
  std::vector<std::string> fields;                        ///< besides id, material and body
  bool grid = false;
  int every_nth = 1;                ///< of the particles: those whose id is a multiple
  std::optional<ShapeSpec> region;  ///< only particles that are in it at the frame's time
  double from = 0;                  ///< s, first time of a frame
  std::optional<double> until;      ///< s, last time of a frame; none: time.end

  /// The name of the grid's files.
  std::string grid_name() const { return name == "particles" ? "grid" : name + "_grid"; }
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
const Schema<OutputSpec>& frames_schema();
const Schema<HistorySpec>& history_schema();
const Schema<CheckpointSpec>& checkpoint_schema();

}  // namespace scree
