// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "solver/io/vtk_frame.hpp"

namespace scree {

/// A numbered series of frames in a run folder and the collection file that lists them with their
/// times. A frame is complete before the collection names it, and the collection is replaced in
/// one piece, so both are readable at any moment.
class FrameSeries {
 public:
  /// The series `name`.pvd + frames/`name`_NNNNNN.*; the folder frames/ must exist.
  FrameSeries(std::filesystem::path run_folder, std::string name, FramePrecision precision);

  /// Writes particles_NNNNNN.vtu and the collection. Throws RunFault.
  void add(const ParticleSnapshot& snapshot);

  /// Writes one .vti a lattice and the collection; two lattices are two parts of one time. A
  /// single lattice named "nodes" is `name`_NNNNNN.vti, others `name`_<lattice>_NNNNNN.vti.
  void add(const std::vector<GridSnapshot>& lattices);

  /// Goes on after the frames at `times`: removes later ones from folder and collection. Throws
  /// RunFault if one of the frames to keep is missing.
  void resume(const std::vector<double>& times);

  const std::vector<double>& times() const { return times_; }  ///< s, of the frames written
  std::string last_file() const;  ///< relative to the run folder, "" before the first frame

 private:
  void write_collection() const;

  std::filesystem::path folder_;
  std::string name_;
  FramePrecision precision_;
  std::vector<double> times_;
  std::vector<std::vector<std::string>> files_;  ///< a frame: its parts, relative to the folder
};

}  // namespace scree
