// SPDX-License-Identifier: Apache-2.0
//
// How much a test does: all of it in builds that run fast, a sample under the sanitizers.
#pragma once

namespace scree::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool slow_build = true;
#else
inline constexpr bool slow_build = false;
#endif

/// `full` repetitions, or a tenth of them (at least one) in slow builds.
constexpr int effort(int full) {
  if (!slow_build) return full;
  return full > 10 ? full / 10 : 1;
}

}  // namespace scree::testing
