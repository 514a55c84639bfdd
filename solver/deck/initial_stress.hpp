// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "solver/deck/deck.hpp"
#include "solver/deck/initial_pressure.hpp"

namespace scree {

/// The stress of a body at the start as a function of the place: normal stresses xx, yy, zz along
/// the axes [Pa], tension positive; no shear stress. Effective where there is pore water: where it
/// flows, geostatic stress is that of the total weight less the initial pore pressure, and water
/// that stands above the surface loads it; a total uniform stress is likewise less that pressure.
class InitialStress {
 public:
  /// Geostatic needs gravity at t = 0 along one axis (a check of the deck). A k0 that the deck does
  /// not give comes from the law (MaterialEntry::rest_ratio).
  InitialStress(const Deck& deck, const BodySpec& body, const MaterialSpec& material);

  std::array<double, 3> at(const double* x) const;
  bool geostatic() const { return spec_.type == InitialStressType::geostatic; }
  /// Whether it is the effective part of a total stress that the deck gives.
  bool total() const { return !geostatic() && spec_.total; }
  /// Pore pressure at the start, compression positive [Pa].
  double pressure(const double* x) const { return pressure_.at(x); }
  int axis() const { return axis_; }
  double k0() const { return k0_; }
  void set_k0(double k0) { k0_ = k0; }
  /// Below the free surface, along gravity [m].
  double depth(const double* x) const { return down_ * (x[axis_] - spec_.surface); }

 private:
  InitialStressSpec spec_;
  InitialPressure pressure_;
  int axis_ = 0;
  double down_ = -1;   ///< sign of gravity along the axis
  double weight_ = 0;  ///< per volume [N/m^3]
  double k0_ = 0;
};

/// Gravity at t = 0 [m/s^2].
std::array<double, 3> gravity_at_start(const Deck& deck);

/// The axis of gravity at t = 0, or -1 where it is zero or along none.
int gravity_axis(const Deck& deck);

/// What particles at `position` (3 each [m]) with this stress start from, and which of the states
/// each has. Every distinct stress is solved for once.
struct InitialStates {
  std::vector<std::vector<double>> states;
  std::vector<std::int32_t> state_of;
};

/// Throws UserError where the law cannot carry a stress.
InitialStates solve_initial_states(const Deck& deck, const BodySpec& body,
                                   const std::vector<double>& position);

/// What is wrong with the stress of a body whose particles lie at `position`, or nothing; of many
/// particles a sample is tried, the highest and the lowest one in it. `key` is empty or one of
/// initial_stress.
std::optional<Finding> initial_stress_fault(const Deck& deck, const BodySpec& body,
                                            const std::vector<double>& position);

}  // namespace scree
