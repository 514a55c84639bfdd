// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/deck/deck.hpp"
#include "solver/particles/sampling.hpp"
#include "solver/particles/surface.hpp"

namespace scree {

/// A mistake of a deck that shows once the particles of a body are known.
struct BodyFault {
  std::vector<std::string> path;  ///< of the key, e.g. {"traction", "top", "region"}
  std::string message, repair;

  /// The path as one dotted key.
  std::string key() const;
};

/// "[0.1, 0.2]": the first `dimension` coordinates, nine digits.
std::string point_text(const std::array<double, 3>& x, int dimension);

/// The faces of a body that a traction loads at t = 0; those on a closed face of the domain are
/// held there, not free.
SurfacePatch loaded_faces(const Deck& deck, const TractionSpec& traction, const SampledBody& body);

/// Velocities of the body, body forces at its particles and its tractions at t = 0 that are no
/// finite numbers, and tractions that load no face. Keys that have a problem already are left out.
std::vector<BodyFault> particle_faults(const Deck& deck, const BodySpec& body,
                                       const SampledBody& particles, const Problems& problems);

}  // namespace scree
