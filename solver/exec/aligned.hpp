// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace scree {

/// Allocator of memory aligned for the widest vector register and a cache line (64 bytes).
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  /// Arrays of several huge pages are given to the system as such: blocks visit particles and nodes
  /// in an order that misses the address translation of small pages often.
  static constexpr std::size_t huge_page = std::size_t(2) << 20;

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    void* p = ::operator new(bytes, alignment_of(bytes));
#ifdef MADV_HUGEPAGE
    if (is_large(bytes)) (void)madvise(p, bytes, MADV_HUGEPAGE);  // advice only: may be refused
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment_of(n * sizeof(T))); }

  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }

 private:
  static bool is_large(std::size_t bytes) { return bytes >= 4 * huge_page; }
  static std::align_val_t alignment_of(std::size_t bytes) {
    return is_large(bytes) ? std::align_val_t(huge_page) : alignment;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace scree
