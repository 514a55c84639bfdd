// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "solver/base/schema.hpp"

namespace scree {

/// The laboratory tests that the element driver knows.
enum class LabTest {
  isotropic,           ///< equal strain in all directions
  oedometer,           ///< axial strain, no lateral strain
  triaxial_drained,    ///< axial strain, constant lateral stress
  triaxial_undrained,  ///< axial strain, constant volume or water in the pores
  simple_shear,        ///< F = [[1, g, 0], [0, l, 0], [0, 0, 1]]
  gradient             ///< any final deformation gradient, in equal increments
};

/// The name of a type in decks.
const char* lab_test_name(LabTest type);

/// `[path]`: how a material point is driven. Strains are logarithmic, stresses Cauchy; both are
/// positive in compression. Axis 1 is the axial one.
struct PathSpec {
  LabTest type = LabTest::isotropic;
  std::optional<double> confining_pressure;  ///< Pa; none: the pressure of the initial state
  double strain = std::numeric_limits<double>::quiet_NaN();  ///< volumetric, axial or shear
  std::optional<double> unload;                              ///< strain to go back to
  int cycles = 1;                                            ///< times `strain`, then `unload`
  int steps = 1000;                                          ///< of each way
  double duration = 1;                                       ///< s, of each way
  std::optional<double> normal_stress;                       ///< Pa, on axis 2 of simple_shear
  std::array<double, 9> gradient;                            ///< final F, row-major
  double initial_void_ratio = 0;

  PathSpec() { gradient.fill(std::numeric_limits<double>::quiet_NaN()); }
};

const Schema<PathSpec>& path_schema();

}  // namespace scree
