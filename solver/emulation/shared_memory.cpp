// SPDX-License-Identifier: Apache-2.0
#include "solver/emulation/shared_memory.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#endif

namespace scree::emulation {
namespace {

constexpr unsigned char guard_byte = 0xA5;
constexpr unsigned char empty_byte = 0xFF;  // all bits set: NaN as float and as double

}  // namespace

void SharedMemory::poison([[maybe_unused]] Piece& piece) {
#ifdef __SANITIZE_ADDRESS__
  ASAN_POISON_MEMORY_REGION(piece.memory.data(), guard);
  ASAN_POISON_MEMORY_REGION(piece.memory.data() + guard + piece.bytes,
                            piece.memory.size() - guard - piece.bytes);
#endif
}

void SharedMemory::unpoison([[maybe_unused]] Piece& piece) {
#ifdef __SANITIZE_ADDRESS__
  ASAN_UNPOISON_MEMORY_REGION(piece.memory.data(), piece.memory.size());
#endif
}

SharedMemory::~SharedMemory() {
  for (Piece& piece : pieces_) unpoison(piece);
}

void SharedMemory::begin_block() {
  for (Piece& piece : pieces_) piece.used = false;
}

void* SharedMemory::piece(const void* name, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  auto it = std::find_if(pieces_.begin(), pieces_.end(),
                         [name](const Piece& piece) { return piece.name == name; });
  if (it == pieces_.end()) {
    pieces_.push_back({name, bytes, AlignedVector<unsigned char>(bytes + 2 * guard), false});
    it = pieces_.end() - 1;
    std::fill(it->memory.begin(), it->memory.end(), guard_byte);
    poison(*it);
  }
  if (!it->used) {
    it->used = true;
    std::fill_n(it->memory.data() + guard, bytes, empty_byte);
    std::size_t total = 0;
    for (const Piece& piece : pieces_) total += piece.used ? piece.bytes : 0;
    if (total > limit) {
      throw std::logic_error("a block asks for " + std::to_string(total) +
                             " bytes of shared memory; a GPU gives " + std::to_string(limit));
    }
  }
  return it->memory.data() + guard;
}

void SharedMemory::end_block() const {
#ifndef __SANITIZE_ADDRESS__
  const auto clean = [](unsigned char byte) { return byte == guard_byte; };
  for (const Piece& piece : pieces_) {
    const unsigned char* end = piece.memory.data() + guard + piece.bytes;
    if (std::all_of(piece.memory.data(), piece.memory.data() + guard, clean) &&
        std::all_of(end, piece.memory.data() + piece.memory.size(), clean)) {
      continue;
    }
    throw std::logic_error("a kernel wrote beyond its " + std::to_string(piece.bytes) +
                           " bytes of shared memory");
  }
#endif
}

}  // namespace scree::emulation
