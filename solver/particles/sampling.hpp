// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/particles/sampling_lattice.hpp"
#include "solver/particles/shape.hpp"

namespace scree {

/// The particles of a body at t = 0, in the order of their sites (x fastest, then y, then z).
struct SampledBody {
  std::vector<double> position;  ///< m, 3 per particle; z = 0 in 2D
  double particle_volume = 0;    ///< m^3; in 2D m^2, that is m^3 per metre of thickness
  double spacing = 0;            ///< m, between neighbours: cell_size / particles_per_direction
  SampleLattice lattice;         ///< on which they lie

  std::int64_t count() const { return static_cast<std::int64_t>(position.size() / 3); }
};

/// Fills a shape with particles: one at the centre of each cell of the lattice of spacing
/// cell_size / particles_per_direction, counted from `domain_lower`, whose centre is in the shape.
/// A box whose sides are multiples of the spacing gets exactly volume / spacing^d particles
/// wherever it lies, and shapes that share a face share no particle: a centre on the surface
/// belongs to the body on its side of larger coordinates. Takes one signed distance for each
/// site of the shape's bounds, two passes over memory and one bit a site.
/// \param domain_lower m; \param cell_size m, > 0; \param particles_per_direction >= 1
/// \throws UserError if the shape is unbounded or far too large for its particles.
SampledBody sample(const Shape& shape, const std::array<double, 3>& domain_lower, double cell_size,
                   int particles_per_direction, int dimension);

}  // namespace scree
