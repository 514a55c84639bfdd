// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace scree {

/// One particle in double precision and SI units, for output.
struct ParticleView {
  std::int64_t id = 0;
  std::array<double, 3> position{};   ///< [m]
  std::array<double, 3> velocity{};   ///< [m/s]
  double affine[3][3] = {};           ///< B [m^2/s]
  std::array<double, 6> kirchhoff{};  ///< [Pa]: xx, xy, xz, yy, yz, zz; with the pore water's share
  std::optional<double> pore_pressure;  ///< [Pa]; nothing without pore water
  double biot = 1;                      ///< share of the pore pressure in the total stress
  std::optional<double> porosity;       ///< of coupled pore water
  std::array<double, 3> seepage{};      ///< [m/s], the same
  double fluid_mass = 0;                ///< [kg], the same
  double volume_ratio = 1;              ///< total J
  double energy_density = 0;            ///< [J/m^3] of reference volume
  std::int32_t batch = 0;               ///< where its material state lies
  int lane = 0;
};

}  // namespace scree
