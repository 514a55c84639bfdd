// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "postproc/run/run.hpp"

namespace scree {

/// How far and how high is measured: along a horizontal axis from a line, or in all horizontal
/// directions from an upright axis; height against gravity from a base.
struct Measure {
  Direction up;
  Direction along;  ///< of the front; not used when radial
  bool radial = false;
  std::array<double, 3> origin{};  ///< m; a point of the line or axis that distances start from
  double base = 0;                 ///< m, height that counts as zero, along the up axis
  double share = 0.995;            ///< of the volume that lies behind the front

  double distance(const double* x) const;
  double height(const double* x) const;
};

/// A frame measured. Particles end half their spacing beyond their centres.
struct Extent {
  double time = 0;      ///< s
  double front = 0;     ///< m, behind which the share of the volume lies
  double farthest = 0;  ///< m, the outermost particle
  double back = 0;      ///< m, the innermost particle's side
  double height = 0;    ///< m, the highest particle
  double centre = 0;    ///< m, mean distance
  double centre_height = 0;
};

Extent measure(const Measure& measure, const WeightedFrame& frame,
               const std::vector<double>& half_spacing);

/// Half the initial particle spacing of each particle [m].
std::vector<double> half_spacings(const Run& run, const ParticleSnapshot& particles);

/// A point of the outline.
struct OutlinePoint {
  double distance = 0;  ///< m; radial: the angle in degrees
  double value = 0;     ///< m, height of the surface; radial: distance of the front at this angle
};

/// Highest particle in each bin of `width` metres of distance; radial: the front in each of 72
/// sectors of 5 degrees about the axis. Bins without particles are left out.
std::vector<OutlinePoint> outline(const Measure& measure, const WeightedFrame& frame,
                                  const std::vector<double>& half_spacing, double width);

}  // namespace scree
