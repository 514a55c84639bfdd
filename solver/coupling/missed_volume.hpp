// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace scree {

/// Volume of the pores that tr(dt grad v) misses, alpha V0 (J - J_0 (1 + sum tr(dt grad v))) of the
/// particles from one set of points to the next, in hats of the pressure nodes, and when the
/// equations get it.
///
/// Points of single steps: all of it in the step after. Strides of several: what a stride missed is
/// known at its end only; all at once it would be a push, the harder the longer the stride. So the
/// steps of a stride get what they are going to miss at the rate of the stride before, and what
/// that one got too little, over as much time as it took.
class MissedVolume {
 public:
  /// nodes: of the lattice; most: steps of a stride.
  MissedVolume(std::int64_t nodes, int most)
      : most_(most),
        foreseen_(most > 1 ? std::size_t(nodes) : 0, 0.0),
        left_(std::size_t(nodes), 0.0) {}

  /// The points are new. missed: since the last ones, by lattice node [m^3].
  void begin(const std::vector<double>& missed) {
    if (most_ == 1) {
      left_ = missed;
      return;
    }
    const double rest = span_ > 0 ? 1 - made_up_ / span_ : 1.0;
    for (std::size_t n = 0; n < left_.size(); ++n) {
      left_[n] = rest * left_[n] + missed[n] - foreseen_[n] * elapsed_;
      foreseen_[n] = elapsed_ > 0 ? missed[n] / elapsed_ : 0.0;
    }
    span_ = elapsed_;
    elapsed_ = made_up_ = 0;
  }
  /// Of a node in the coming step, of length dt [m^3/s].
  double rate(std::int64_t node, double dt) const {
    const std::size_t n = std::size_t(node);
    if (most_ == 1) return left_[n] / dt;
    return foreseen_[n] + (span_ > 0 ? left_[n] / span_ * share(dt) / dt : 0.0);
  }
  /// That step has been made.
  void advance(double dt) {
    made_up_ += share(dt);
    elapsed_ += dt;
  }

  std::int64_t bytes() const { return std::int64_t(8 * (foreseen_.capacity() + left_.capacity())); }

  // Strides of several steps, for checkpoints.
  bool spreads() const { return most_ > 1; }
  std::vector<double>& foreseen() { return foreseen_; }
  const std::vector<double>& foreseen() const { return foreseen_; }
  std::vector<double>& left() { return left_; }
  const std::vector<double>& left() const { return left_; }
  std::vector<double> times() const { return {span_, elapsed_, made_up_}; }
  void resume(const std::vector<double>& times) {
    span_ = times.at(0);
    elapsed_ = times.at(1);
    made_up_ = times.at(2);
  }

 private:
  /// Of the time in which left_ is made up for, what falls into the coming step.
  double share(double dt) const { return std::min(dt, span_ - made_up_); }

  int most_;
  std::vector<double> foreseen_;  ///< of this stride [m^3/s]
  std::vector<double> left_;      ///< of those before it [m^3]; of single steps what is due
  double span_ = 0;               ///< of the stride before [s]
  double elapsed_ = 0;            ///< of this one [s]
  double made_up_ = 0;            ///< of span_ [s]
};

}  // namespace scree
