// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/boundary/traction_spec.hpp"
#include "solver/deck/expression.hpp"

namespace scree {

/// Evaluates a traction for one particle at a time. Not for several threads at once: its
/// expressions keep their own storage; give each thread a copy.
class Traction {
 public:
  Traction(const TractionSpec& spec, int dimension);

  /// True for a pressure, which needs the deformation gradient.
  bool follows_surface() const { return follows_; }

  /// The force on a particle, N (2D: N/m).
  /// A pressure p gives -p cof(F) A = -p J F^-T A (Nanson's formula for the present area vector);
  /// a value gives value |A|, with the reference area of surface.hpp.
  /// \param t s; \param x present, \param start initial position, m
  /// \param area_vector, area see SurfacePatch
  /// \param F deformation gradient since t = 0 (the total one), used with a pressure only
  /// \throws RunFault if an expression gives no finite number.
  Vec3<double> force(double t, const Vec3<double>& x, const Vec3<double>& start,
                     const Vec3<double>& area_vector, double area, const Mat3<double>& F) const;

 private:
  double load(std::size_t i, const double values[7]) const;

  std::string name_;
  bool follows_;
  std::vector<Expression> load_;  ///< the pressure, or `dimension` components of the value
};

}  // namespace scree
