// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "app/bench_measure.hpp"

namespace scree {

/// What the memory delivers, in the manner of STREAM (J. McCalpin) [bytes/s]: bytes read and
/// written by the program; what the hardware moves besides is not counted.
struct Bandwidth {
  int threads = 1;
  std::int64_t array_bytes = 0;
  BestMedian copy;    ///< b[i] = s a[i]
  BestMedian update;  ///< a[i] = s a[i], the way in which a step treats its particles
};

/// Measures with arrays of about so many bytes each (two of them) and this many threads.
Bandwidth measure_bandwidth(int threads, std::int64_t array_bytes, int repeats);

/// Arrays that caches do not hold: several times the last level, within the free memory.
std::int64_t bandwidth_array_bytes(std::int64_t cache_bytes, std::int64_t free_bytes);

}  // namespace scree
