// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "solver/particles/shape.hpp"

namespace scree {

/// A simple polygon in the x-y plane; in 3D the prism over it between two heights.
class PolygonShape final : public Shape {
 public:
  /// `points`: corners in either sense of rotation; `z`: heights, used in 3D only.
  PolygonShape(std::vector<std::array<double, 2>> points, const std::array<double, 3>& z,
               int dimension);
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;

 private:
  struct Nearest {
    double distance;  ///< to the outline, signed
    double away[2];   ///< from the nearest point of the outline to x
    std::size_t edge;
  };
  Nearest nearest(const double x[3]) const;
  void outline_normal(const Nearest& near, double n[2]) const;

  std::vector<std::array<double, 2>> points_;  ///< counter-clockwise
  std::array<double, 3> z_;                    ///< [0] to [1]
  double size_;  ///< largest coordinate magnitude: sets what counts as lying on the outline
};

/// Area of a polygon, m^2, positive for counter-clockwise corners.
double signed_area(const std::vector<std::array<double, 2>>& points);

}  // namespace scree
