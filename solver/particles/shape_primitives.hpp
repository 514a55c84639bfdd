// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "solver/particles/shape.hpp"

namespace scree {

/// Two coordinates that bound a solid, each negative inside: the product of an interval or outline
/// with another, such as a cylinder (axial x radial) or an extruded polygon (outline x height).
/// The solid is q[0] < 0 and q[1] < 0, and both are distances along perpendicular directions.
struct Wedge {
  double distance;   ///< exact signed distance of the product solid
  double weight[2];  ///< its gradient with respect to q; a unit vector

  Wedge(double q0, double q1);
};

/// Axis-aligned box; a rectangle in 2D.
class BoxShape final : public Shape {
 public:
  BoxShape(const std::array<double, 3>& lower, const std::array<double, 3>& upper, int dimension);
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override { return box_; }

 private:
  Box box_;
};

/// Sphere; a disk in 2D.
class SphereShape final : public Shape {
 public:
  SphereShape(const std::array<double, 3>& center, double radius, int dimension);
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;

 private:
  std::array<double, 3> center_;
  double radius_;
};

/// Circular cylinder with flat ends; in 2D a rectangle of any direction.
class CylinderShape final : public Shape {
 public:
  CylinderShape(const std::array<double, 3>& from, const std::array<double, 3>& to, double radius,
                int dimension);
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;

 private:
  struct Local {
    double axial;      ///< from the middle, along the axis, signed
    double radial[3];  ///< vector from the axis
    double radius;     ///< its length
  };
  Local local(const double x[3]) const;

  std::array<double, 3> middle_{};
  std::array<double, 3> axis_{};    ///< unit vector
  std::array<double, 3> across_{};  ///< a unit vector perpendicular to it: the normal on the axis
  double half_length_;
  double radius_;
};

/// The half space behind a plane.
class PlaneShape final : public Shape {
 public:
  PlaneShape(const std::array<double, 3>& point, const std::array<double, 3>& normal,
             int dimension);
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;
  std::array<double, 3> reference_point() const override { return point_; }

 private:
  std::array<double, 3> point_;
  std::array<double, 3> normal_{};
};

}  // namespace scree
