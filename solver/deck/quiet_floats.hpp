// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfenv>

namespace scree {

/// While it lives, floating-point exceptions neither stop the program nor leave a mark: reading
/// "1e400" and trying "1/t" at t = 0 must give a sentence, also in builds that trap.
class QuietFloats {
 public:
  QuietFloats() { std::feholdexcept(&environment_); }
  ~QuietFloats() { std::fesetenv(&environment_); }
  QuietFloats(const QuietFloats&) = delete;
  QuietFloats& operator=(const QuietFloats&) = delete;

 private:
  std::fenv_t environment_;
};

}  // namespace scree
