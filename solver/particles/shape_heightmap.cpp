// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape_heightmap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree {

TerrainShape::TerrainShape(std::shared_ptr<const HeightRaster> raster, double base)
    : Shape(3),
      raster_(std::move(raster)),
      base_(base),
      shrink_(1 / std::hypot(1.0, raster_->steepest())) {
  const auto lower = raster_->lower(), upper = raster_->upper();
  box_ = {{lower[0], lower[1], base}, {upper[0], upper[1], raster_->highest()}};
}

double TerrainShape::signed_distance(const double x[3]) const {
  double distance = std::max((x[2] - raster_->height(x[0], x[1])) * shrink_, base_ - x[2]);
  for (std::size_t a = 0; a < 2; ++a)
    distance = std::max({distance, box_.lower[a] - x[a], x[a] - box_.upper[a]});
  return distance;
}

void TerrainShape::normal(const double x[3], double n[3]) const {
  double slope[2];
  raster_->height(x[0], x[1], slope);
  const double length = std::hypot(slope[0], slope[1], 1.0);
  n[0] = -slope[0] / length;
  n[1] = -slope[1] / length;
  n[2] = 1 / length;
}

Box TerrainShape::bounds() const { return box_; }

ProfileShape::ProfileShape(HeightProfile profile, double base)
    : Shape(2),
      profile_(std::move(profile)),
      base_(base),
      shrink_(1 / std::hypot(1.0, profile_.steepest())),
      highest_(profile_.highest()) {}

double ProfileShape::signed_distance(const double x[3]) const {
  return std::max({(x[1] - profile_.height(x[0])) * shrink_, base_ - x[1], profile_.lower() - x[0],
                   x[0] - profile_.upper()});
}

void ProfileShape::normal(const double x[3], double n[3]) const {
  double slope = 0;
  profile_.height(x[0], &slope);
  const double length = std::hypot(slope, 1.0);
  n[0] = -slope / length;
  n[1] = 1 / length;
  n[2] = 0;
}

Box ProfileShape::bounds() const {
  return {{profile_.lower(), base_, 0}, {profile_.upper(), highest_, 0}};
}

}  // namespace scree
