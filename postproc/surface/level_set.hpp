// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postproc/project/lattice.hpp"
#include "postproc/run/run.hpp"

namespace scree {

/// The share of the volume around each node that particles fill: 1 inside a body, 1/2 at its
/// surface, 0 outside. The surface is the level 1/2.
struct LevelSet {
  Lattice lattice;
  std::vector<double> fraction;  ///< a node
};

/// On a lattice aligned with the domain that reaches two cells beyond the particles. Each particle
/// gives its volume to the corners of its cell, multilinearly. The faces of the domain count as
/// mirrors, so that a body does not seem to end half filled there.
LevelSet volume_fraction(const Run& run, const WeightedFrame& frame, double spacing);

/// The highest crossing of the level 1/2 in each upright line of nodes.
struct SurfacePoint {
  std::array<double, 3> place{};  ///< m
  double height = 0;              ///< m, coordinate along the up axis times its sign
};

/// Lines without material are left out.
std::vector<SurfacePoint> free_surface(const LevelSet& level, Direction up);

/// The whole level 1/2 as lines (2D) or triangles (3D).
struct SurfaceMeasure {
  double size = 0;  ///< m in 2D (per metre of thickness m^2), m^2 in 3D
  std::size_t pieces = 0;
};

/// Writes it as .vtp; with an empty path only measures. Throws RunFault.
SurfaceMeasure write_surface(const LevelSet& level, const std::string& path);

}  // namespace scree
