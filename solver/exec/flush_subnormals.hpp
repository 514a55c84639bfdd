// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace scree {

/// While it lives, this thread takes numbers below the normal range (1e-38 single, 1e-308 double)
/// for zero, results and operands alike. Rotations that converge and weights near a cell's edge
/// produce them all the time; processors take a hundred cycles for each, and no result depends on
/// them. On other processors than x86 it does nothing.
class FlushSubnormals {
 public:
#ifdef __SSE2__
  FlushSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | flush_to_zero); }
  /// Keeps the exception flags that were raised meanwhile.
  ~FlushSubnormals() { _mm_setcsr((_mm_getcsr() & ~flush_to_zero) | (before_ & flush_to_zero)); }
#else
  FlushSubnormals() {}
  ~FlushSubnormals() {}
#endif
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

#ifdef __SSE2__
 private:
  static constexpr unsigned flush_to_zero = 0x8040;  // flush results, take operands for zero
  unsigned before_;
#endif
};

}  // namespace scree
