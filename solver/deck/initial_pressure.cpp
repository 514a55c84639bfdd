// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/initial_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/deck/initial_stress.hpp"

namespace scree {

InitialPressure::InitialPressure(const Deck& deck, const MaterialSpec& material) {
  const auto pores = material.pores();
  if (!deck.coupling || !pores) return;
  biot_ = pores->biot;
  const CouplingSpec& coupling = *deck.coupling;
  if (coupling.initial_pressure.given()) {
    formula_.emplace(coupling.initial_pressure.text, std::vector<std::string>{"x", "y", "z"});
  }
  if (!coupling.water_table) return;
  axis_ = gravity_axis(deck);
  if (axis_ < 0) return;  // a mistake of the deck, reported by its checks
  const double gravity = gravity_at_start(deck)[std::size_t(axis_)];
  down_ = gravity < 0 ? -1 : 1;
  table_ = *coupling.water_table;
  weight_ = pores->fluid_density * std::abs(gravity);
}

double InitialPressure::at(const double* x) const {
  if (formula_) return (*formula_)(x);
  if (axis_ < 0) return 0;
  return weight_ * std::max(0.0, down_ * (x[axis_] - table_));
}

}  // namespace scree
