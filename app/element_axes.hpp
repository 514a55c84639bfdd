// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/element/element_test.hpp"

namespace scree {

/// Whether axes 2 and 3 of a test are alike.
bool axisymmetric(LabTest type);

/// Stresses of a test for pictures: compression positive, without rounding, in a unit in which they
/// are numbers that can be read.
class StressScale {
 public:
  StressScale(const ElementDeck& deck, const ElementResult& result);

  const char* unit() const { return unit_; }
  /// What is not above it is only rounding [Pa].
  double noise() const { return noise_; }
  double settled(double stress) const;    ///< zero for rounding [Pa]
  double shown(double stress) const;      ///< from Pa to the unit
  double p(const ElementRow& row) const;  ///< [Pa]
  double q(
      const ElementRow& row) const;  ///< [Pa], with the sign of sigma_1 - sigma_3 if axisymmetric

 private:
  bool axisymmetric_;
  double noise_ = 0, size_ = 1;
  const char* unit_ = "Pa";
};

/// The strain along which a test is plotted, in percent unless it is a flow.
class StrainAxis {
 public:
  StrainAxis(const ElementResult& result, LabTest type);

  double operator()(const ElementRow& row) const;
  bool shear() const { return kind_ == Kind::shear; }
  const char* label() const;

 private:
  enum class Kind { axial, volumetric, shear };
  Kind kind_ = Kind::axial;
  bool large_ = false;
};

}  // namespace scree
