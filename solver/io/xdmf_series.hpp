// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/io/frame_file.hpp"
#include "solver/io/frame_series.hpp"

namespace scree {

/// The series `name`.xdmf + `name`.h5: all frames in one HDF5 file and an XDMF 3 index of it. The
/// index is written when the frame it names is on the disk.
class XdmfSeries final : public FrameSeries {
 public:
  /// For about `expected` frames; `deflate` packs the arrays.
  XdmfSeries(std::filesystem::path run_folder, std::string name, FramePrecision precision,
             bool deflate, std::size_t expected);

  void add(const ParticleSnapshot& snapshot) override;
  void add(const std::vector<GridSnapshot>& lattices) override;
  void save(StateWriter& writer, const std::string& prefix) const override;
  void resume(const StateReader& reader, const std::string& prefix) override;
  std::string last_file() const override;

 private:
  FrameFile& file();
  void add_entry(double time, std::string entry);
  void write_index() const;
  std::vector<FrameArray> field_arrays(const std::vector<SnapshotField>& fields,
                                       const std::vector<std::size_t>& points,
                                       const std::string& group) const;

  std::filesystem::path folder_;
  std::string name_;
  FramePrecision precision_;
  bool deflate_;
  std::size_t expected_;
  std::optional<FrameFile> file_;     ///< from the first frame on
  std::vector<std::string> entries_;  ///< of the index, one a frame
};

}  // namespace scree
