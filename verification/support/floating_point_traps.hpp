// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfenv>

namespace scree::testing {

/// Floating-point exceptions kill the process while this lives: no lane may divide by zero,
/// overflow or make a NaN, not even in a branch that a select drops.
class FloatingPointTraps {
 public:
  FloatingPointTraps() : before_(fegetexcept()) {
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
  }
  ~FloatingPointTraps() {
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(before_);
  }
  FloatingPointTraps(const FloatingPointTraps&) = delete;
  FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;

 private:
  int before_;
};

}  // namespace scree::testing
