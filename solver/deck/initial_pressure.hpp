// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "solver/deck/deck.hpp"
#include "solver/deck/expression.hpp"

namespace scree {

/// The pore pressure of a material at the start, as a function of the place. Zero without
/// [coupling] and in materials without a porosity.
class InitialPressure {
 public:
  InitialPressure(const Deck& deck, const MaterialSpec& material);

  /// Pressure at x, 3 coordinates [m]; not finite where the deck's formula is not.
  double at(const double* x) const;
  /// Share of it in the total stress.
  double biot() const { return biot_; }

 private:
  std::optional<Expression> formula_;
  int axis_ = -1;  ///< of gravity, with a water table
  double down_ = -1, table_ = 0, weight_ = 0;
  double biot_ = 0;
};

}  // namespace scree
