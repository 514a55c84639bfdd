// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "solver/particles/shape.hpp"

namespace scree {

using ShapeList = std::vector<std::unique_ptr<Shape>>;

/// True if one of them is.
bool any_costly(const ShapeList& parts);

/// All points of any part.
class UnionShape final : public Shape {
 public:
  UnionShape(ShapeList parts, int dimension);
  bool inside(const double x[3]) const override;
  bool costly() const override { return any_costly(parts_); }
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;

 private:
  ShapeList parts_;
};

/// The points common to all parts.
class IntersectionShape final : public Shape {
 public:
  IntersectionShape(ShapeList parts, int dimension);
  bool inside(const double x[3]) const override;
  bool costly() const override { return any_costly(parts_); }
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;

 private:
  ShapeList parts_;
};

/// The points of the first part that are in none of the others.
class DifferenceShape final : public Shape {
 public:
  DifferenceShape(ShapeList parts, int dimension);
  bool inside(const double x[3]) const override;
  bool costly() const override { return any_costly(parts_); }
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override { return parts_.front()->bounds(); }

 private:
  /// The signed distance of part i as a bound of the difference: turned inside out but for i = 0.
  double side(std::size_t i, const double x[3]) const;

  ShapeList parts_;
};

}  // namespace scree
