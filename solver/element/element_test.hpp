// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/material.hpp"
#include "materials/material_point.hpp"
#include "solver/element/element_deck.hpp"
#include "solver/element/motion.hpp"

namespace scree {

/// One row of the table: the state after a step. Stresses are effective where there is water.
struct ElementRow {
  int step = 0;
  PathStrain strain;
  Sym3<double> cauchy;  ///< Pa, tension positive
  double void_ratio = 0;
  std::vector<double> entries;  ///< the law's state, in the order of its fields
  /// Pa, excess over that of the confined state: with water in the pores, and at constant volume in
  /// triaxial_undrained.
  std::optional<double> pore_pressure;
  std::optional<double> yield_value;

  double pressure() const;    ///< p [Pa]
  double deviatoric() const;  ///< q = sqrt(3/2) |s| [Pa]
};

/// What a drive gave: the confined state as row 0, then a row a step.
struct ElementResult {
  std::vector<ElementRow> rows;
  std::vector<StateField> fields;  ///< of the law's state
  bool void_ratio_known = false;   ///< by the law or the deck
  /// The point at the end (without water), for a closer look at its law.
  std::unique_ptr<MaterialPoint> point;
};

/// Drives the point of a deck without problems along its path. Throws RunFault with step and cause
/// where the law cannot follow.
ElementResult drive_element(const ElementDeck& deck);

}  // namespace scree
