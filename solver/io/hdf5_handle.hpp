// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the files that use HDF5 share. Its own header is included by sources alone, so its types
/// stand here by their meaning; hdf5_handle.cpp checks that they are the same.

#include <cstdint>
#include <string>
#include <utility>

#include "solver/io/state_archive.hpp"

namespace scree {

using Hdf5Id = std::int64_t;  ///< hid_t

/// Owns an HDF5 object; `close` is the H5?close of its kind.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  Hdf5Handle(Hdf5Id id, int (*close)(Hdf5Id)) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { release(); }

  bool valid() const { return id_ >= 0; }
  Hdf5Id get() const { return id_; }
  /// Closes the object; false if that failed.
  bool release() {
    const Hdf5Id id = std::exchange(id_, -1);
    return id < 0 || close_(id) >= 0;
  }

 private:
  Hdf5Id id_ = -1;
  int (*close_)(Hdf5Id) = nullptr;
};

/// Starts the library: silent (failures become exceptions at the callers) and without its exit
/// handler, which would try once more to flush a file that could not be written.
void start_hdf5();

/// The operating system's words for the last HDF5 failure, after ": ", or nothing.
std::string hdf5_system_message();

/// The library's type of such numbers in memory.
Hdf5Id hdf5_type(ElementType type);

}  // namespace scree
