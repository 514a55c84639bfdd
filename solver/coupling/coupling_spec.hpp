// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "solver/base/schema.hpp"
#include "solver/coupling/coupling_setup.hpp"
#include "solver/particles/shape_spec.hpp"

namespace scree {

/// `[coupling]`: water flows in the pores of the materials that have a porosity.
struct CouplingSpec {
  std::string type;                   ///< "biot"
  int pressure_spacing = 2;           ///< of the pressure nodes, in cells
  double tolerance = 1e-8;            ///< of the pressure solve
  std::string preconditioner;         ///< a PETSc PCType; empty: by dimension
  std::string solver_options;         ///< PETSc options with the prefix scree_p_
  int halvings = 0;                   ///< of a step whose solve does not converge
  int stride = 64;                    ///< steps that may share their points
  double stride_drift = 0.001;        ///< of particles in such steps, in cells
  std::optional<double> water_table;  ///< coordinate along gravity's axis, m
  Formula initial_pressure;           ///< Pa, of x, y, z
};

/// `[drainage.NAME]`: pore pressure or flux on exposed faces of a body's particles.
struct DrainageSpec {
  std::string name;
  std::string body;
  std::optional<ShapeSpec> region;  ///< holds the faces' centres at t = 0; not given: all
  std::array<double, 3> facing{};   ///< as of a traction
  bool walls = false;               ///< also faces that lie on a closed face of the domain
  DrainageType type = DrainageType::drained;
  Formula pressure;  ///< Pa, of x, y, z, t
  Formula flux;      ///< outflow, m/s, of x, y, z, t
};

const Schema<CouplingSpec>& coupling_schema();
const Schema<DrainageSpec>& drainage_schema();

}  // namespace scree
