// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

namespace scree {

/// Where a run stands.
struct ProgressState {
  double time = 0;  ///< s, simulated
  std::int64_t step = 0;
  double dt = 0;       ///< s
  double updates = 0;  ///< particle updates since the start of this call
};

/// How progress is shown: a bar that is redrawn, a line now and then, or nothing.
enum class ProgressStyle { bar, lines, none };

/// Shows simulated time, step, dt, particle updates per second and the time left.
class Progress {
 public:
  using Clock = std::function<double()>;  ///< wall clock, s

  /// `start` and `end` are the simulated times [s] of this call: where it begins, and where it will
  /// stop. A step may end a little beyond `end`.
  Progress(std::FILE* out, ProgressStyle style, double start, double end, Clock clock);

  /// Call it after every step; it decides itself whether to write.
  void update(const ProgressState& state);

  /// Ends the bar's line, so that other text can follow.
  void finish(const ProgressState& state);

 private:
  bool due(double now, double fraction) const;
  std::string text(const ProgressState& state, double now) const;
  void write(const ProgressState& state, double now);

  std::FILE* out_;
  ProgressStyle style_;
  double start_, end_;
  Clock clock_;
  double started_ = 0;
  double last_written_ = 0;
  double last_fraction_ = 0;
};

/// "0:07", "12:34", "3:05:00"; seconds rounded to the nearest.
std::string clock_text(double seconds);

/// A bar on a terminal, lines elsewhere, nothing when quiet.
ProgressStyle progress_style(std::FILE* out, bool quiet);

}  // namespace scree
