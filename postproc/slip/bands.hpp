// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "postproc/run/run.hpp"

namespace scree {

/// Cells of a regular grid whose mean strain is above a threshold and that touch each other.
struct ShearBand {
  std::size_t cells = 0;
  double volume = 0;               ///< m^3; in 2D m^2
  double mean = 0, largest = 0;    ///< of the strain
  std::array<double, 3> centre{};  ///< m
  double length = 0;               ///< m, of its skeleton: the longest shortest way through it
  double thickness = 0;            ///< m; 2D: volume over length; 3D: from the spread across it
  double angle = 0;                ///< deg, to the horizontal; 3D: dip of the plane
  std::array<double, 3> first{}, last{};  ///< m, ends of the skeleton
};

/// Means of a quantity in square cells aligned with the domain.
struct CellField {
  double spacing = 1;  ///< m
  struct Cell {
    std::array<long, 3> at{};
    double mean = 0, volume = 0;
  };
  std::vector<Cell> cells;  ///< that hold particles, in order of `at`
};

CellField cell_field(const Run& run, const WeightedFrame& frame, const std::vector<double>& values,
                     double spacing);

/// Half of the value that 99 % of the filled cells stay below.
double default_threshold(const CellField& field);

/// Bands of at least `least` cells, the largest volume first. Cells touch by a face, an edge or a
/// corner.
std::vector<ShearBand> shear_bands(const Run& run, const CellField& field, double threshold,
                                   std::size_t least);

}  // namespace scree
