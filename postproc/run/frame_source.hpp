// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "solver/io/snapshot.hpp"

namespace scree {

/// What a frame holds for each particle besides position, id, material and body.
struct FieldInfo {
  std::string name;
  int components = 1;  ///< 1, 3 or 9
};

/// The particle frames of a run, whatever the format of its files. One frame is in memory at a
/// time: the one that read() returns. Everything here throws UserError, with the file's name, for
/// a file that cannot be read.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Times of all complete frames when the run was opened, ascending [s].
  virtual const std::vector<double>& times() const = 0;

  virtual std::vector<FieldInfo> fields(std::size_t frame) const = 0;

  /// Position, id, material, body and the named fields, each of which must be among fields().
  virtual ParticleSnapshot read(std::size_t frame,
                                const std::vector<std::string>& fields) const = 0;
};

/// The frames of a run folder. Throws UserError when there are none.
std::unique_ptr<FrameSource> open_frames(const std::filesystem::path& folder);

/// The frame whose time is nearest to `time` [s].
std::size_t nearest_frame(const FrameSource& frames, double time);

}  // namespace scree
