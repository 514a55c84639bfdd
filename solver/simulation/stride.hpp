// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// Steps in which the particles act on the grid from one place (stride_ops.hpp).
class Stride {
 public:
  Stride() = default;
  /// most: steps, at least 1; most_drift: of a particle from that place [cells].
  Stride(int most, double most_drift) : most_(most), most_drift_(most > 1 ? most_drift : 0) {}

  /// Whether the coming step is the first of a stride, and whether the last.
  bool begins() const { return steps_ == 0; }
  bool ends() const { return ends_; }
  int longest() const { return most_; }
  double most_drift() const { return most_drift_; }

  /// Decides whether the coming step is the last; move: how far a particle goes in one [cells].
  /// The step after it would add its own.
  void plan(double move) { ends_ = steps_ + 1 >= most_ || drift_ + 2 * move > most_drift_; }
  /// The step was made, in which no particle went farther than `move` [cells].
  void note(double move) {
    steps_ = ends_ ? 0 : steps_ + 1;
    drift_ = ends_ ? 0 : drift_ + move;
  }

  // Between two steps.
  int steps() const { return steps_; }
  double drift() const { return drift_; }
  void resume(int steps, double drift) {
    steps_ = steps;
    drift_ = drift;
  }

 private:
  int most_ = 1;
  double most_drift_ = 0;
  int steps_ = 0;     ///< of the present stride so far
  double drift_ = 0;  ///< bound of how far a particle has moved in it [cells]
  bool ends_ = true;
};

}  // namespace scree
