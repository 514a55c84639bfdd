// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "solver/exec/aligned.hpp"

namespace scree::emulation {

/// The shared memory of one block at a time: pieces between guards, filled with NaN at each block's
/// start. What is written to a guard shows at the block's end, or at once under an address
/// sanitizer.
class SharedMemory {
 public:
  static constexpr std::size_t limit = 48 * 1024;  ///< what every GPU gives a block [bytes]

  ~SharedMemory();
  void begin_block();
  void* piece(const void* name, std::size_t bytes);
  /// Throws std::logic_error where a guard was written to.
  void end_block() const;

 private:
  static constexpr std::size_t guard = 64;
  struct Piece {
    const void* name;
    std::size_t bytes;
    AlignedVector<unsigned char> memory;  ///< guard, piece, guard
    bool used;
  };
  static void poison(Piece& piece);
  static void unpoison(Piece& piece);

  std::mutex mutex_;
  std::vector<Piece> pieces_;
};

}  // namespace scree::emulation
