// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/fault_text.hpp"

#include <fmt/format.h>

namespace scree {
namespace {

std::string inadmissible(const ParticleFault& fault) {
  if (fault.inadmissible) {
    return fmt::format("{} (volume ratio J = {:.3g}); {}", fault.inadmissible->what, fault.value,
                       fault.inadmissible->repair);
  }
  return fmt::format(
      "was deformed beyond what its material can represent (volume ratio J = {:.3g});"
      " lower time.cfl, use more particles per direction or a stiffer material",
      fault.value);
}

std::string what(const ParticleFault& fault) {
  switch (fault.code) {
    case FaultCode::moved_too_far:
      return fmt::format(
          "moved {:.2g} dx in one step, more than the bound of 0.25 dx; lower time.cfl",
          fault.value);
    case FaultCode::inadmissible_state:
      return inadmissible(fault);
    case FaultCode::not_finite:
      return "has a velocity that is not a finite number; lower time.cfl and check the material's "
             "parameters";
    case FaultCode::left_domain:
      return fmt::format(
          "went {:.2g} dx beyond the limit of one cell outside a closed face of the "
          "domain; lower time.cfl or use a finer grid",
          fault.value);
    case FaultCode::none:
      break;
  }
  return "is at fault for an unknown reason";
}

/// The texts say time.cfl, a key that a deck with a fixed step may not have.
std::string with_key_in_force(std::string text, bool fixed_step) {
  const std::string key = "time.cfl";
  const std::size_t at = fixed_step ? text.find(key) : std::string::npos;
  return at == std::string::npos ? text : text.replace(at, key.size(), "time.step");
}

}  // namespace

std::string place_text(const double* x, int dimension) {
  return dimension == 2 ? fmt::format("({:.4g}, {:.4g}) m", x[0], x[1])
                        : fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x[0], x[1], x[2]);
}

std::string fault_text(const ParticleFault& fault) {
  return fmt::format("step {}: particle {} ({}) at {} {}", fault.step, fault.id, fault.material,
                     place_text(fault.position.data(), fault.dimension),
                     with_key_in_force(what(fault), fault.fixed_step));
}

std::string mass_fault_text(std::int64_t step, double grid_mass, double particle_mass) {
  return fmt::format(
      "step {}: the grid holds a mass of {:.17g} kg, the particles {:.17g} kg; this is a defect of "
      "the "
      "program, please report it with the deck",
      step, grid_mass, particle_mass);
}

std::string count_fault_text(std::int64_t step, std::int64_t present, std::int64_t removed,
                             std::int64_t initial) {
  return fmt::format(
      "step {}: {} particles are present and {} left through open faces, but {} were there at the "
      "start; "
      "this is a defect of the program, please report it with the deck",
      step, present, removed, initial);
}

}  // namespace scree
