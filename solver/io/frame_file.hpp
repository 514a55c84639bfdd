// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "solver/io/state_archive.hpp"

namespace scree {

/// One array of a frame. Memory stays with the caller until the frame is written.
struct FrameArray {
  std::string name;  ///< '/' makes a group
  std::string unit;  ///< kept as the attribute "unit" where there is one
  std::vector<std::size_t> size;
  ElementType type = ElementType::float64;
  const void* values = nullptr;
  bool as_single = false;  ///< float64 values that are stored as float32, infinite beyond its range

  std::size_t count() const;
};

/// What brings a file of frames back to the moment at which this was taken, though frames were
/// added since: its length, and the parts of it that later frames write over.
struct FrameFileState {
  std::int64_t length = 0;            ///< bytes
  std::int64_t frames = 0;            ///< in the file
  std::int64_t slots = 0;             ///< groups there are for frames
  std::vector<std::int64_t> batches;  ///< the first frame of each batch of such groups
  std::vector<std::int64_t> regions;  ///< of each batch: first byte and length of its part
  std::vector<std::uint8_t> bytes;    ///< of the parts, one after the other

  void save(StateWriter& writer, const std::string& prefix) const;
  void load(const StateReader& reader, const std::string& prefix);  ///< throws RunFault
};

/// Frames in one HDF5 file that grows: whatever stops the program, the frames written before can be
/// read, while the next one is being written too.
///
/// HDF5 changes groups where they lie when something is added to them. So every frame's group is
/// there, empty, before the first frame is written; a frame changes its own group, adds its arrays
/// at the end of the file and then, in one write, the file's head. Groups for more frames than were
/// expected are made in the group "more" beside the first ones, "more/more" and so on.
class FrameFile {
 public:
  /// A new file for about `expected` frames. Arrays are cut into chunks of about 1 MB; `deflate`
  /// packs them (level 1). Throws RunFault.
  static FrameFile create(const std::filesystem::path& path, std::size_t expected, bool deflate);

  /// Goes on with a file after cutting it back to `state`. Throws RunFault if it is missing or
  /// shorter than it was.
  static FrameFile resume(const std::filesystem::path& path, const FrameFileState& state,
                          bool deflate);

  FrameFile(FrameFile&&) noexcept;
  FrameFile& operator=(FrameFile&&) noexcept;
  ~FrameFile();

  /// Adds a frame and puts it on the disk. Returns the path of its group in the file. Throws
  /// RunFault (disk full); the file is then what it was before.
  std::string add(double time, std::int64_t step, const std::vector<FrameArray>& arrays);

  /// For resume(); the state after the last frame added.
  const FrameFileState& state() const;

 private:
  struct File;
  explicit FrameFile(std::unique_ptr<File> file);
  std::unique_ptr<File> file_;
};

}  // namespace scree
