// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/step_limit.hpp"

#include <fmt/format.h>

#include "solver/simulation/fault_text.hpp"

namespace scree {
namespace {

std::string particles(const StepLimit& limit) {
  if (limit.name.empty()) return "the particles";
  return fmt::format("particles of {} near {}", limit.name,
                     place_text(limit.place.data(), limit.dimension));
}

}  // namespace

std::string cause_text(const StepLimit& limit) {
  switch (limit.cause) {
    case StepLimit::Cause::fixed:
      return "time.step; lengthen it";
    case StepLimit::Cause::collider:
      return fmt::format("collider {}, which moves at {:.3g} m/s; prescribe a slower motion",
                         limit.name, limit.speed);
    case StepLimit::Cause::motion:
      return fmt::format("{}, which move at {:.3g} m/s; lower the loads that drive them",
                         particles(limit), limit.speed);
    case StepLimit::Cause::waves:
      break;
  }
  return fmt::format(
      "{}, where waves and motion reach {:.3g} m/s; squeeze the material less, or more slowly",
      particles(limit), limit.speed);
}

std::string short_step_text(double time, const StepLimit& limit) {
  return fmt::format(
      "at t = {:.6g} s the time step has fallen from {:.2g} s to {:.2g} s because of {}", time,
      limit.first, limit.now, cause_text(limit));
}

std::string step_fault_text(std::int64_t step, double time, const StepLimit& limit) {
  return fmt::format("step {}: the run would not end: {}", step, short_step_text(time, limit));
}

}  // namespace scree
