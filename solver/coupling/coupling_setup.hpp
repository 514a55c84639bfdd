// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace scree {

/// Pores and pore water of a material, SI.
struct PoreSetup {
  double porosity = 0;           ///< n0 at t = 0, in (0, 1)
  double fluid_modulus = 2.2e9;  ///< K_f [Pa]
  double grain_compliance = 0;   ///< 1/K_s [1/Pa]; 0: incompressible grains
  double biot = 1;               ///< Biot's coefficient alpha, in [n0, 1]
  double mobility = 0;           ///< permeability over viscosity at t = 0 [m^2/(Pa s)]
  double fluid_density = 1000;   ///< [kg/m^3]
  bool kozeny_carman = false;    ///< mobility follows the porosity as n^3/(1-n)^2
};

/// Porosity at the volume ratio J since t = 0: grains keep their volume, n = 1 - (1 - n0)/J.
inline double porosity_at(const PoreSetup& pores, double volume_ratio) {
  return 1 - (1 - pores.porosity) / volume_ratio;
}

/// Biot's storage 1/M = n/K_f + (alpha - n)/K_s [1/Pa].
inline double storage_at(const PoreSetup& pores, double porosity) {
  return porosity / pores.fluid_modulus + (pores.biot - porosity) * pores.grain_compliance;
}

/// Mobility [m^2/(Pa s)], with Kozeny and Carman's dependence on the porosity where it is asked
/// for.
inline double mobility_at(const PoreSetup& pores, double porosity) {
  if (!pores.kozeny_carman) return pores.mobility;
  const double r = porosity / pores.porosity, s = (1 - pores.porosity) / (1 - porosity);
  return pores.mobility * r * r * r * s * s;
}

enum class DrainageType {
  drained,   ///< pressure zero
  pressure,  ///< given pressure [Pa]
  flux,      ///< given outflow per area [m/s], inflow negative
};

/// One exposed face of a particle's lattice cell at t = 0.
struct DrainedFace {
  std::int64_t particle = 0;       ///< index into its body's particles
  std::array<double, 3> area{};    ///< outward normal times area [m^2] (2D: m)
  std::array<double, 3> offset{};  ///< face centre minus particle [m]
};

/// Pore pressure or flux on a surface of one body.
struct DrainageSetup {
  std::string name;
  DrainageType type = DrainageType::drained;
  std::int32_t body = 0;
  /// Pressure [Pa] or outflow [m/s] at position x [m] and time t [s]; empty: zero.
  std::function<double(const double* x, double t)> value;
  std::vector<DrainedFace> faces;
};

/// The water in the pores of all bodies.
struct CouplingSetup {
  int pressure_spacing = 2;    ///< of the pressure nodes, in cells: 1 (compact kernel) or 2
  double tolerance = 1e-8;     ///< residual of the pressure solve over that of the right-hand side
  std::string preconditioner;  ///< PETSc's PCType; empty: by dimension
  std::string solver_options;  ///< PETSc options with the prefix scree_p_
  /// How often a step whose solve does not converge is halved before the run ends.
  int halvings = 0;
  /// Fused path: steps that particles may act on the grid from one place, and how far they may move
  /// meanwhile [cells].
  int stride = 64;
  double stride_drift = 0.001;
  std::vector<DrainageSetup> drainage;
};

}  // namespace scree
