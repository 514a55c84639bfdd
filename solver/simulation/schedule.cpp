// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace scree {
namespace {
constexpr double same_event = 1e-9;
}

Schedule::Schedule(double end, double history_every, double frame_every, double checkpoint_every)
    : end_(end), interval_{history_every, frame_every, checkpoint_every} {}

bool Schedule::due(int stream, double t) const {
  const double every = interval_[stream];
  if (!(every > 0)) return false;
  return std::abs(t - std::round(t / every) * every) <= same_event * every;
}

double Schedule::event(int stream, double t) const {
  if (at_end(t)) return end_;
  const double every = interval_[stream];
  return every > 0 ? std::round(t / every) * every : 0;
}

std::size_t Schedule::frame_count() const {
  const double every = interval_[1];
  if (!(every > 0)) return 2;
  constexpr double most = 1e9;  // nobody writes more; a count stays a count
  return static_cast<std::size_t>(std::min(most, std::ceil(end_ / every * (1 - same_event)))) + 1;
}

bool Schedule::at_end(double t) const { return std::abs(t - end_) <= same_event * end_; }

double Schedule::next_event(double t) const {
  double next = end_;
  for (const double every : interval_) {
    if (!(every > 0)) continue;
    const double event = (std::floor(t / every + same_event) + 1) * every;
    // An event just before the end is the end.
    if (event < end_ - same_event * end_) next = std::min(next, event);
  }
  return next;
}

}  // namespace scree
