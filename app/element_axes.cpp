// SPDX-License-Identifier: Apache-2.0
#include "app/element_axes.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

bool axisymmetric(LabTest type) {
  return type != LabTest::simple_shear && type != LabTest::gradient;
}

StressScale::StressScale(const ElementDeck& deck, const ElementResult& result)
    : axisymmetric_(axisymmetric(deck.driven.type)) {
  double largest = 0, invariant = 0;
  for (const ElementRow& row : result.rows) {
    largest = std::max({largest, norm(row.cauchy), std::abs(row.pore_pressure.value_or(0))});
    invariant = std::max({invariant, std::abs(row.pressure()), row.deviatoric()});
  }
  // Held stresses are found to 1e-10 of the largest; strains of order one have rounding errors,
  // collected over thousands of steps, which the stiffness rho c^2 multiplies.
  const double speed = result.point->wave_speed();
  const double stiffness = deck.materials.front().density * speed * speed;
  noise_ = std::max(1e-9 * largest, std::isfinite(stiffness) ? 1e-12 * stiffness : 0.0);
  if (invariant >= 1e3) {
    size_ = invariant >= 1e7 ? 1e6 : 1e3;
    unit_ = invariant >= 1e7 ? "MPa" : "kPa";
  }
}

double StressScale::settled(double stress) const { return std::abs(stress) > noise_ ? stress : 0; }

double StressScale::shown(double stress) const { return stress / size_; }

double StressScale::p(const ElementRow& row) const { return settled(row.pressure()); }

double StressScale::q(const ElementRow& row) const {
  const Sym3<double>& s = row.cauchy;
  const bool extended = axisymmetric_ && s.xx > 0.5 * (s.yy + s.zz);
  const double q = settled(row.deviatoric());
  return extended && q > 0 ? -q : q;
}

StrainAxis::StrainAxis(const ElementResult& result, LabTest type) {
  const PathStrain& last = result.rows.back().strain;
  if (type == LabTest::isotropic) kind_ = Kind::volumetric;
  if (type == LabTest::simple_shear) kind_ = Kind::shear;
  if (type == LabTest::gradient && std::abs(last.shear) > std::abs(last.axial)) {
    kind_ = Kind::shear;
  }
  for (const ElementRow& row : result.rows) {
    large_ = large_ || (shear() && std::abs(row.strain.shear) > 2);
  }
}

double StrainAxis::operator()(const ElementRow& row) const {
  if (kind_ == Kind::shear) return (large_ ? 1 : 100) * row.strain.shear;
  return 100 * (kind_ == Kind::volumetric ? row.strain.volumetric : row.strain.axial);
}

const char* StrainAxis::label() const {
  if (large_) return "Shear strain";
  if (shear()) return "Shear strain (%)";
  return kind_ == Kind::volumetric ? "Volumetric strain (%)" : "Axial strain (%)";
}

}  // namespace scree
