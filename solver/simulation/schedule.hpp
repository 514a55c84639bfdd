// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace scree {

/// The times at which a run must stop exactly: history rows, frames, checkpoints and the end.
///
/// Event k of a stream lies at k * interval (so rounding does not add up), and at the end for
/// history and frames. Two events closer than 1e-9 of the interval count as one.
class Schedule {
 public:
  Schedule() = default;
  /// end > 0 [s]; intervals [s], 0 = no such events (history and frames: then only t = 0 and end).
  Schedule(double end, double history_every, double frame_every, double checkpoint_every);

  double end() const { return end_; }
  bool history_due(double t) const { return due(0, t) || at_end(t) || t == 0; }
  bool frame_due(double t) const { return due(1, t) || at_end(t) || t == 0; }
  /// Not at t = 0: there is nothing to save yet.
  bool checkpoint_due(double t) const { return t > 0 && due(2, t); }
  /// True where the particles' velocities and stresses will be asked for.
  bool record_due(double t) const { return history_due(t) || frame_due(t); }
  bool finished(double t) const { return t >= end_ || at_end(t); }
  /// Time of the event that is due at t. Steps much shorter than an interval see the same one more
  /// than once.
  double history_event(double t) const { return event(0, t); }
  double frame_event(double t) const { return event(1, t); }
  double checkpoint_event(double t) const { return event(2, t); }
  /// Frames of the whole run, the first and the last included.
  std::size_t frame_count() const;
  /// The first event after t, at most the end; the end itself once it is reached.
  double next_event(double t) const;

 private:
  bool due(int stream, double t) const;
  double event(int stream, double t) const;
  bool at_end(double t) const;

  double end_ = 0;
  std::array<double, 3> interval_{};
};

}  // namespace scree
