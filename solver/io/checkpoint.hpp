// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "solver/io/state_archive.hpp"

namespace scree {

/// Writes a checkpoint, an HDF5 file with one checked dataset an array. The file grows aside
/// (`path`.tmp); commit() puts it on the disk and gives it its name, so `path` is at any moment
/// the old or the new checkpoint, never half a one. Without commit() the file aside is removed.
class CheckpointWriter : public StateWriter {
 public:
  explicit CheckpointWriter(const std::filesystem::path& path);  ///< throws RunFault
  ~CheckpointWriter() override;

  void put_text(const std::string& name, const std::string& text) override;
  void commit();  ///< throws RunFault (disk full); the old checkpoint is then still there

 protected:
  void put_array(const std::string& name, ElementType type, const void* values,
                 std::size_t count) override;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Reads a checkpoint. Throws RunFault, in one sentence with the path, if the file is missing,
/// truncated, damaged (every array carries a checksum), or of another program or format version.
class CheckpointReader : public StateReader {
 public:
  explicit CheckpointReader(const std::filesystem::path& path);
  ~CheckpointReader() override;

  bool has(const std::string& name) const override;
  std::string text(const std::string& name) const override;

 protected:
  std::size_t array_size(const std::string& name, ElementType type) const override;
  void read_array(const std::string& name, ElementType type, void* values,
                  std::size_t count) const override;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace scree
