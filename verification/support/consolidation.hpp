// SPDX-License-Identifier: Apache-2.0
//
// Columns of saturated soil, drained at the top.
#pragma once

#include <cmath>
#include <vector>

#include "verification/support/scene.hpp"

namespace scree::testing {

/// A column along the last axis of `dimension`, cells x cell_size high, held by mirror planes at
/// its sides and its foot; the soil is linear elastic under confined compression.
struct SoilColumn {
  int dimension = 2;
  int cells = 20;               ///< of the height
  int particles = 3;            ///< a direction
  int extra = 0;                ///< layers of particles above the last whole cell
  double height = 1;            ///< [m]
  double youngs_modulus = 1e7;  ///< [Pa]
  double poissons_ratio = 0.0;
  double density = 2000;
  double load = 1e3;  ///< on top [Pa]
  PoreSetup pores;
  CouplingSetup coupling;
  Method method;

  double cell() const { return height / (cells + double(extra) / particles); }
  double oedometer_modulus() const {
    const double nu = poissons_ratio;
    return youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  }
  double wave_speed() const { return std::sqrt(oedometer_modulus() / density); }
  /// k (1/M + alpha^2/E_oed)^-1 [m^2/s]
  double consolidation() const {
    const double storage = storage_at(pores, pores.porosity);
    return pores.mobility / (storage + pores.biot * pores.biot / oedometer_modulus());
  }
  /// Sets the mobility that gives this coefficient of consolidation.
  void set_consolidation(double cv) {
    const double storage = storage_at(pores, pores.porosity);
    pores.mobility = cv * (storage + pores.biot * pores.biot / oedometer_modulus());
  }
};

/// The column with the load on its drained top; `drained`: its top is a drain.
SimulationSetup column_setup(const SoilColumn& column, bool drained = true);

/// The upper faces of the highest points of a lattice of this spacing, whose top is at `height`, as
/// the drain "top".
DrainageSetup drained_top(const std::vector<Vector>& points, double height, double spacing,
                          int dimension);

}  // namespace scree::testing
