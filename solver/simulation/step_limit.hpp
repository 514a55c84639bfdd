// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace scree {

/// What bounds the time step where no output is due.
struct StepLimit {
  enum class Cause { waves, motion, collider, fixed };

  double first = 0;  ///< bound at t = 0 [s]; 0 where there was none
  double now = 0;    ///< bound of the coming step [s]
  Cause cause = Cause::waves;
  double speed = 0;  ///< that sets it [m/s]: of waves, of the motion, of the collider
  std::string name;  ///< of the material or the collider; empty where it is not known
  int dimension = 3;
  std::array<double, 3> place{};  ///< of the particles, to half a block of the grid [m]

  /// Bound now over bound at the start; 1 where that says nothing.
  double shrinkage() const { return first > 0 ? now / first : 1; }
};

/// "particles of sand near (0.1, 0.2) m, where waves run at 1e+06 m/s; load them more slowly": what
/// sets the step, and what helps.
std::string cause_text(const StepLimit& limit);

/// "at t = 0.1 s the time step has fallen from 1e-4 s to 1e-8 s because of ...".
std::string short_step_text(double time, const StepLimit& limit);

/// A step so small that the run would never end: one sentence.
std::string step_fault_text(std::int64_t step, double time, const StepLimit& limit);

}  // namespace scree
