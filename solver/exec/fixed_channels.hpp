// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace scree {

/// Node sums in fixed point: multiples of a mass and of a momentum, both powers of two, so that
/// the conversion rounds once.
///
/// The units are 2^-46 of a particle's mass and of mass x dx/dt, about the largest momentum that a
/// particle may have: more than double precision keeps of such a sum. What a particle gives is
/// bounded by 2^52 units, that is 64 dx/dt, and 2^11 such particles a node fit into 64 bits.
struct FixedChannels {
  using Value = unsigned long long;  ///< two's complement; the type that CUDA adds atomically
  static constexpr double limit = 0x1p52;

  Value* sum[2] = {nullptr, nullptr};  ///< like the channels of a grid
  double mass = 1;                     ///< [kg]
  double momentum = 1;                 ///< [kg m/s]
  double per_mass = 1;                 ///< 1/mass, exact
  double per_momentum = 1;             ///< 1/momentum, exact
  std::int32_t* overflow = nullptr;    ///< becomes 1 where a contribution is too large or NaN

  /// The units for particles of at most mass m [kg] and a speed scale v [m/s].
  void set_units(double m, double v) {
    mass = std::ldexp(1.0, std::ilogb(m) - 45);
    momentum = std::ldexp(1.0, std::ilogb(m * v) - 45);
    per_mass = 1 / mass;
    per_momentum = 1 / momentum;
  }
};

}  // namespace scree
