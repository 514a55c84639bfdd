// SPDX-License-Identifier: Apache-2.0
#include "solver/element/yield_locus.hpp"

#include <algorithm>
#include <cmath>

#include "solver/base/eigen.hpp"
#include "solver/base/stress_invariants.hpp"
#include "solver/element/held_step.hpp"

namespace scree {
namespace {

/// Of the dimensionless yield function; what lies nearer to the surface counts as yielding.
constexpr double touching = 1e-7;
/// Rates of strain vanish: points of laws that know time are probed at rest.
constexpr double long_time = 1e9;

double pressure(const MaterialPoint& point) { return mean_pressure(cauchy_stress(point)); }
double deviatoric(const MaterialPoint& point) { return deviatoric_stress(cauchy_stress(point)); }

/// Moves a point about in the elastic domain of one state.
class Probe {
 public:
  /// Starts at the point's present state, and unloads its deviator. Strains of shear have the
  /// size of those of an axial strain.
  Probe(MaterialPoint& point, const ShearDirection& d) : point_(point), direction_(d) {
    const double size = std::sqrt(1.5 / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
    for (double& component : direction_) component *= size;
    unload();
    start_ = point_.entries();
    stress_ = cauchy_stress(point_);
  }

  /// Whether the point stays inside of the surface under a volumetric strain and a shear, both
  /// logarithmic, compression positive. The point is moved there.
  bool move(double volumetric, double shear) {
    point_.set_entries(start_);
    strain(volumetric, shear);
    const std::vector<double> there = point_.entries();
    const bool inside = point_.admissible() && *point_.yield_value() < -touching;
    const bool elastic = inside && returns(volumetric, shear);
    point_.set_entries(there);
    return elastic;
  }

  /// The largest amount below 0.3 that stays inside; `at` makes the move for an amount.
  template <class Move>
  static double largest(Move at) {
    double outside = 1e-8, inside = 0;
    while (outside < 0.3 && at(outside)) {
      inside = outside;
      outside *= 2;
    }
    for (int i = 0; i < 60 && outside < 0.3; ++i) {
      const double middle = 0.5 * (inside + outside);
      (at(middle) ? inside : outside) = middle;
    }
    return inside;
  }

  /// The volumetric strain between the two at which the pressure is p: pressure rises with it.
  double volumetric_at(double p, double low, double high) {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      move(middle, 0);
      (pressure(point_) < p ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  std::pair<double, double> stress() const { return {pressure(point_), deviatoric(point_)}; }

 private:
  void strain(double volumetric, double shear) {
    Mat3<double> step = zero3<double>();
    for (int i = 0; i < 3; ++i) {
      const double part = direction_[static_cast<std::size_t>(i)];
      step(i, i) = std::expm1(-shear * part - volumetric / 3);
    }
    point_.advance(step, long_time);
  }

  /// Whether the opposite strain leads back to the stress at the start: some laws harden after the
  /// return map, so that a state which has yielded lies inside of the new surface.
  bool returns(double volumetric, double shear) {
    const Sym3<double> there = cauchy_stress(point_);
    strain(-volumetric, -shear);
    const Sym3<double> back = cauchy_stress(point_);
    return norm(back - stress_) <= 1e-6 * norm(there - stress_);
  }

  /// Strains against the deviator of stress, as far as its present slope says, until it is gone.
  void unload() {
    for (int i = 0; i < 50; ++i) {
      const double q = deviatoric(point_);
      if (q <= 1e-9 * std::abs(pressure(point_)) || q <= 1e-9) return;
      const Sym3<double> s = deviator(cauchy_stress(point_));
      const Mat3<double> direction = to_mat(s) * (1 / norm(s));
      const std::vector<double> before = point_.entries();
      constexpr double small = 1e-8;
      point_.advance(direction * -small, long_time);
      const double slope = (q - deviatoric(point_)) / small;
      point_.set_entries(before);
      if (!(slope > 0)) return;
      point_.advance(direction * -std::min(q / slope, 0.01), long_time);
    }
  }

  MaterialPoint& point_;
  ShearDirection direction_;
  std::vector<double> start_;
  Sym3<double> stress_;
};

}  // namespace

ShearDirection shear_direction(const ElementRow& row, double negligible) {
  if (!(row.deviatoric() > negligible)) return triaxial_compression;
  const Vec3<double> values = eigen_symmetric(deviator(row.cauchy)).values;
  return {-values[0], -values[1], -values[2]};
}

std::vector<std::pair<double, double>> yield_locus(const ElementResult& result,
                                                   const ShearDirection& direction,
                                                   PressureRange range) {
  std::vector<std::pair<double, double>> points;
  if (!result.rows.back().yield_value) return points;
  MaterialPoint& point = *result.point;
  point.set_entries(result.rows.back().entries);
  Probe probe(point, direction);
  const double out = -Probe::largest([&](double v) { return probe.move(-v, 0); });
  const double in = Probe::largest([&](double v) { return probe.move(v, 0); });
  probe.move(out, 0);
  const double first = std::max(probe.stress().first, range.low);
  probe.move(in, 0);
  const double last = std::min(probe.stress().first, range.high);
  constexpr int samples = 80;
  for (int i = 0; i <= samples && last > first; ++i) {
    // Closer together at the ends, where the surface may be steep.
    const double share = 0.5 - 0.5 * std::cos(3.14159265358979 * i / samples);
    const double volumetric = probe.volumetric_at(first + share * (last - first), out, in);
    const double shear = Probe::largest([&](double a) { return probe.move(volumetric, a); });
    probe.move(volumetric, shear);
    points.push_back(probe.stress());
  }
  return points;
}

}  // namespace scree
