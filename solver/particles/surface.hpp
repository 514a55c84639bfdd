// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/particles/sampling.hpp"

namespace scree {

/// Which exposed faces to select.
struct SurfaceSelection {
  const Shape* region = nullptr;   ///< holds the face's centre, rim included; null: everywhere
  std::array<double, 3> facing{};  ///< outward normal within 60 degrees of this; zero: any
  /// A wall covers the faces that lie on it: there the body is held, not free. wall[a][0] is
  /// the domain's face below in axis a (at the lattice's lower corner), wall[a][1] that above.
  std::array<std::array<bool, 2>, 3> wall{};
  std::array<double, 3> domain_upper{};  ///< m; used where wall[a][1]
};

/// The selected surface of a body at t = 0, particle by particle, in ascending order.
struct SurfacePatch {
  std::vector<std::int64_t> particle;  ///< index into the body's positions
  std::vector<double> area_vector;     ///< 3 per entry, m^2 (2D: m): sum of outward normal * area
  /// m^2 (2D: m), one per entry: the length of the area vector, but with faces that look in
  /// opposite directions (a body one particle thick) added rather than cancelled.
  std::vector<double> area;

  std::int64_t count() const { return static_cast<std::int64_t>(particle.size()); }
};

/// One exposed face of a particle's lattice cell.
struct SurfaceFace {
  std::int64_t particle = 0;  ///< index into the body's positions
  int axis = 0, sign = 1;     ///< of its outward normal
};

/// The selected faces one by one, particle by particle.
std::vector<SurfaceFace> single_faces(const SampledBody& body, const SurfaceSelection& selection);

/// The faces of the particles' lattice cells that have no particle of the body on the other side.
/// A surface that is not aligned with the lattice comes out as a staircase, whose area vectors sum
/// to the right projected areas.
SurfacePatch exposed_faces(const SampledBody& body, const SurfaceSelection& selection);

}  // namespace scree
