// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "solver/base/tensor.hpp"
#include "solver/element/path_spec.hpp"

namespace scree {

/// Where a point is on its path: the controlled strain, and the logarithm of the stretch that a
/// held stress leaves free. Both are zero in the confined state.
struct PathState {
  double control = 0;
  double free = 0;
};

/// Strains of a path state, compression positive.
struct PathStrain {
  double axial = 0, volumetric = 0, shear = 0;
};

/// Which Cauchy stress is held.
enum class HeldStress {
  mean,     ///< mean pressure
  axis_2,   ///< the normal component on axis 2
  lateral,  ///< the mean of those on axes 2 and 3
};

/// The kinematics of a test: a family of deformation gradients.
class Motion {
 public:
  virtual ~Motion() = default;
  /// L in F <- (I + L) F between two states of the path, without a difference of nearly equal
  /// numbers.
  virtual Mat3<double> increment(const PathState& from, const PathState& to) const = 0;
  virtual PathStrain strain(const PathState& state) const = 0;
};

/// Equal stretches exp(free): the stage that brings a point to its confining pressure.
std::unique_ptr<Motion> confining_motion();
/// F = diag(1, exp(free), 1): the stage that brings a point of simple shear to its normal stress.
std::unique_ptr<Motion> normal_motion();
/// The motion of a path. `water` is whether water in the pores lets triaxial_undrained change its
/// volume.
std::unique_ptr<Motion> path_motion(const PathSpec& path, bool water);

}  // namespace scree
