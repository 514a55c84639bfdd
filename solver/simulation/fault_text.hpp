// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "materials/material.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// A fault of one particle, for the user.
struct ParticleFault {
  FaultCode code = FaultCode::none;
  std::int64_t step = 0;
  std::int64_t id = 0;
  std::string material;
  double value = 0;
  std::optional<InadmissibleText> inadmissible;  ///< the law's own words for such a state
  bool fixed_step = false;  ///< the deck fixes time.step, which then is what to lower
  int dimension = 3;
  std::array<double, 3> position{};  ///< [m]
};

/// "(0.1, 0.2) m"; x: `dimension` coordinates [m].
std::string place_text(const double* x, int dimension);

/// One sentence: step, particle, place, what happened, what to do.
std::string fault_text(const ParticleFault& fault);

/// The grid does not hold the particles' mass.
std::string mass_fault_text(std::int64_t step, double grid_mass, double particle_mass);

/// Particles got lost (or doubled) between the blocks.
std::string count_fault_text(std::int64_t step, std::int64_t present, std::int64_t removed,
                             std::int64_t initial);

}  // namespace scree
