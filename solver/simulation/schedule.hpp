// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace scree {

/// Events at the multiples of an interval that lie in a window of time, its ends included.
struct EventStream {
  double every = 0;  ///< s; 0: none but the first and the last
  double from = 0;   ///< s
  double until = std::numeric_limits<double>::infinity();  ///< s
};

/// The times at which a run must stop exactly: history rows, frames, checkpoints, what else is
/// recorded, and the end.
///
/// Event k of a stream lies at k * interval (so rounding does not add up), and, but for
/// checkpoints, at t = 0 and at the end. Two events closer than 1e-9 of the interval count as one.
class Schedule {
 public:
  static constexpr int history_stream = 0, frame_stream = 1, checkpoint_stream = 2;

  Schedule() = default;
  /// end > 0 [s]; intervals [s], 0 = no such events (history and frames: then only t = 0 and end).
  Schedule(double end, double history_every, double frame_every, double checkpoint_every);

  /// Sets the events of the frames.
  void set_frames(EventStream frames) { streams_[frame_stream] = frames; }
  /// Adds a stream of records; returns its number, from 3 on.
  int add(EventStream stream);

  double end() const { return end_; }
  bool history_due(double t) const { return due(history_stream, t); }
  bool frame_due(double t) const { return due(frame_stream, t); }
  /// Not at t = 0: there is nothing to save yet.
  bool checkpoint_due(double t) const { return due(checkpoint_stream, t); }
  /// True where the particles' velocities and stresses will be asked for.
  bool record_due(double t) const;
  bool finished(double t) const { return t >= end_ || at_end(t); }
  /// Time of the event that is due at t. Steps much shorter than an interval see the same one more
  /// than once.
  double history_event(double t) const { return event(history_stream, t); }
  double frame_event(double t) const { return event(frame_stream, t); }
  double checkpoint_event(double t) const { return event(checkpoint_stream, t); }
  /// Of any stream, by its number.
  bool due(int stream, double t) const;
  double event(int stream, double t) const;

  /// Events of a stream in the whole run, or a few more.
  std::size_t count(int stream) const;
  /// The first event after t, at most the end; the end itself once it is reached.
  double next_event(double t) const;

 private:
  bool at_end(double t) const;

  double end_ = 0;
  std::vector<EventStream> streams_{3};
};

}  // namespace scree
