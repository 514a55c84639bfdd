// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "solver/io/output_spec.hpp"
#include "solver/io/snapshot.hpp"
#include "solver/io/state_archive.hpp"

namespace scree {

/// A numbered series of frames in a run folder and the index that lists them with their times. A
/// frame is complete before the index names it, and the index is replaced in one piece, so both are
/// readable at any moment.
class FrameSeries {
 public:
  virtual ~FrameSeries() = default;

  /// Writes a frame of particles and the index. Throws RunFault.
  virtual void add(const ParticleSnapshot& snapshot) = 0;

  /// Writes a frame of one or more lattices, all of one time, and the index; no lattice, no frame.
  /// Throws RunFault.
  virtual void add(const std::vector<GridSnapshot>& lattices) = 0;

  /// For resume(): what the series consists of now, under names that begin with `prefix`.
  virtual void save(StateWriter& writer, const std::string& prefix) const = 0;

  /// Goes on after the frames there were at save(): removes later ones from folder and index.
  /// Throws RunFault if one of the frames to keep is missing.
  virtual void resume(const StateReader& reader, const std::string& prefix) = 0;

  const std::vector<double>& times() const { return times_; }  ///< s, of the frames written
  /// Where the last frame is, relative to the run folder; "" before the first frame.
  virtual std::string last_file() const = 0;

 protected:
  std::vector<double> times_;
};

/// The series `name` in the format of `spec` (not none), for about `expected` frames.
std::unique_ptr<FrameSeries> make_frame_series(const std::filesystem::path& run_folder,
                                               const std::string& name, const OutputSpec& spec,
                                               std::size_t expected);

}  // namespace scree
