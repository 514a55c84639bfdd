// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "solver/geometry/height_raster.hpp"
#include "solver/particles/shape.hpp"

namespace scree {

/// The ground between a raster of heights and a level base, within the rims of the raster; 3D, z
/// up. The signed distance is a lower bound of the true one: heights are divided by the steepest
/// slope. Contact is with the terrain: the normal is its everywhere, also near base and sides.
class TerrainShape final : public Shape {
 public:
  TerrainShape(std::shared_ptr<const HeightRaster> raster, double base);
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;
  const HeightRaster& raster() const { return *raster_; }

 private:
  std::shared_ptr<const HeightRaster> raster_;
  double base_;
  double shrink_;  ///< 1/sqrt(1 + steepest^2)
  Box box_;
};

/// The same in 2D: below a profile, y up.
class ProfileShape final : public Shape {
 public:
  ProfileShape(HeightProfile profile, double base);
  double signed_distance(const double x[3]) const override;
  void normal(const double x[3], double n[3]) const override;
  Box bounds() const override;

 private:
  HeightProfile profile_;
  double base_;
  double shrink_;
  double highest_;
};

}  // namespace scree
