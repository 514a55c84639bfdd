// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape_primitives.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double length(const double* v, int dimension) {
  double sum = 0;
  for (int a = 0; a < dimension; ++a) sum += v[a] * v[a];
  return std::sqrt(sum);
}

/// Copies `v`, with 0 in the axes a 2D shape does not have.
std::array<double, 3> planar(const std::array<double, 3>& v, int dimension) {
  return {v[0], v[1], dimension == 3 ? v[2] : 0.0};
}

}  // namespace

Wedge::Wedge(double q0, double q1) {
  if (q0 > 0 && q1 > 0) {
    distance = std::sqrt(q0 * q0 + q1 * q1);
    weight[0] = q0 / distance;
    weight[1] = q1 / distance;
  } else {
    distance = std::max(q0, q1);
    weight[0] = q0 >= q1 ? 1 : 0;
    weight[1] = 1 - weight[0];
  }
}

BoxShape::BoxShape(const std::array<double, 3>& lower, const std::array<double, 3>& upper,
                   int dimension)
    : Shape(dimension), box_{planar(lower, dimension), planar(upper, dimension)} {}

double BoxShape::signed_distance(const double x[3]) const {
  double nearest = -infinity, outside = 0;
  for (int a = 0; a < dimension(); ++a) {
    const double q = std::max(box_.lower[a] - x[a], x[a] - box_.upper[a]);
    nearest = std::max(nearest, q);
    if (q > 0) outside += q * q;
  }
  return nearest > 0 ? std::sqrt(outside) : nearest;
}

void BoxShape::normal(const double x[3], double n[3]) const {
  double gap[3] = {0, 0, 0}, nearest = -infinity;
  int face = 0;
  for (int a = 0; a < dimension(); ++a) {
    const double below = box_.lower[a] - x[a], above = x[a] - box_.upper[a];
    const double q = std::max(below, above);
    n[a] = below > above ? -1 : 1;
    gap[a] = q > 0 ? q : 0;
    if (q > nearest) {
      nearest = q;
      face = a;
    }
  }
  const double outside = nearest > 0 ? length(gap, dimension()) : 0;
  for (int a = 0; a < 3; ++a) {
    if (a >= dimension()) {
      n[a] = 0;
    } else {
      n[a] *= outside > 0 ? gap[a] / outside : (a == face ? 1.0 : 0.0);
    }
  }
}

SphereShape::SphereShape(const std::array<double, 3>& center, double radius, int dimension)
    : Shape(dimension), center_(planar(center, dimension)), radius_(radius) {}

double SphereShape::signed_distance(const double x[3]) const {
  double sum = 0;
  for (int a = 0; a < dimension(); ++a) sum += (x[a] - center_[a]) * (x[a] - center_[a]);
  return std::sqrt(sum) - radius_;
}

void SphereShape::normal(const double x[3], double n[3]) const {
  for (int a = 0; a < 3; ++a) n[a] = a < dimension() ? x[a] - center_[a] : 0;
  const double r = length(n, dimension());
  for (int a = 0; a < 3; ++a) n[a] = r > 0 ? n[a] / r : (a == 0 ? 1.0 : 0.0);
}

Box SphereShape::bounds() const {
  Box box;
  for (int a = 0; a < dimension(); ++a) {
    box.lower[a] = center_[a] - radius_;
    box.upper[a] = center_[a] + radius_;
  }
  return box;
}

CylinderShape::CylinderShape(const std::array<double, 3>& from, const std::array<double, 3>& to,
                             double radius, int dimension)
    : Shape(dimension), radius_(radius) {
  for (int a = 0; a < dimension; ++a) {
    middle_[a] = 0.5 * (from[a] + to[a]);
    axis_[a] = to[a] - from[a];
  }
  const double full = length(axis_.data(), dimension);
  half_length_ = 0.5 * full;
  int least = 0;
  for (int a = 0; a < dimension; ++a) {
    axis_[a] /= full;
    if (std::abs(axis_[a]) < std::abs(axis_[least])) least = a;
  }
  // The coordinate axis that is most nearly perpendicular, made exactly so.
  for (int a = 0; a < dimension; ++a)
    across_[a] = (a == least ? 1.0 : 0.0) - axis_[least] * axis_[a];
  const double size = length(across_.data(), dimension);
  for (int a = 0; a < dimension; ++a) across_[a] /= size;
}

CylinderShape::Local CylinderShape::local(const double x[3]) const {
  Local at{0, {0, 0, 0}, 0};
  for (int a = 0; a < dimension(); ++a) at.axial += (x[a] - middle_[a]) * axis_[a];
  for (int a = 0; a < dimension(); ++a) at.radial[a] = x[a] - middle_[a] - at.axial * axis_[a];
  at.radius = length(at.radial, dimension());
  return at;
}

double CylinderShape::signed_distance(const double x[3]) const {
  const Local at = local(x);
  return Wedge(std::abs(at.axial) - half_length_, at.radius - radius_).distance;
}

void CylinderShape::normal(const double x[3], double n[3]) const {
  const Local at = local(x);
  const Wedge wedge(std::abs(at.axial) - half_length_, at.radius - radius_);
  const double along = at.axial < 0 ? -wedge.weight[0] : wedge.weight[0];
  for (int a = 0; a < 3; ++a) {
    const double outward = at.radius > 0 ? at.radial[a] / at.radius : across_[a];
    n[a] = along * axis_[a] + wedge.weight[1] * outward;
  }
}

Box CylinderShape::bounds() const {
  Box box;
  for (int a = 0; a < dimension(); ++a) {
    // Extent of a disk of this radius that is normal to the axis.
    const double disk = radius_ * std::sqrt(std::max(0.0, 1 - axis_[a] * axis_[a]));
    const double reach = half_length_ * std::abs(axis_[a]) + disk;
    box.lower[a] = middle_[a] - reach;
    box.upper[a] = middle_[a] + reach;
  }
  return box;
}

PlaneShape::PlaneShape(const std::array<double, 3>& point, const std::array<double, 3>& normal,
                       int dimension)
    : Shape(dimension), point_(planar(point, dimension)) {
  const double size = length(normal.data(), dimension);
  for (int a = 0; a < dimension; ++a) normal_[a] = normal[a] / size;
}

double PlaneShape::signed_distance(const double x[3]) const {
  double sum = 0;
  for (int a = 0; a < dimension(); ++a) sum += (x[a] - point_[a]) * normal_[a];
  return sum;
}

void PlaneShape::normal(const double[3], double n[3]) const {
  for (int a = 0; a < 3; ++a) n[a] = normal_[a];
}

Box PlaneShape::bounds() const {
  Box box;
  for (int a = 0; a < dimension(); ++a) {
    box.lower[a] = normal_[a] == -1 ? point_[a] : -infinity;
    box.upper[a] = normal_[a] == 1 ? point_[a] : infinity;
  }
  return box;
}

}  // namespace scree
