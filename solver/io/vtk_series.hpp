// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/io/frame_series.hpp"

namespace scree {

/// The series `name`.pvd + frames/`name`_NNNNNN.*; the folder frames/ must exist.
class VtkSeries final : public FrameSeries {
 public:
  VtkSeries(std::filesystem::path run_folder, std::string name, FramePrecision precision);

  /// Writes `name`_NNNNNN.vtu.
  void add(const ParticleSnapshot& snapshot) override;

  /// Writes one .vti a lattice; two lattices are two parts of one time. A single lattice named
  /// "nodes" is `name`_NNNNNN.vti, others `name`_<lattice>_NNNNNN.vti.
  void add(const std::vector<GridSnapshot>& lattices) override;

  void save(StateWriter& writer, const std::string& prefix) const override;
  void resume(const StateReader& reader, const std::string& prefix) override;
  /// The same for frames at these times.
  void resume(const std::vector<double>& times);

  std::string last_file() const override;

 private:
  void write_collection() const;

  std::filesystem::path folder_;
  std::string name_;
  FramePrecision precision_;
  std::vector<std::vector<std::string>> files_;  ///< a frame: its parts, relative to the folder
};

}  // namespace scree
