// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace scree {
namespace {

constexpr double same_event = 1e-9;

/// The first event of a stream after t, in its window or beyond it.
double next_of(const EventStream& stream, double t) {
  const double next = (std::floor(t / stream.every + same_event) + 1) * stream.every;
  if (next >= stream.from * (1 - same_event)) return next;
  return std::ceil(stream.from / stream.every - same_event) * stream.every;
}

bool in_window(const EventStream& stream, double t) {
  return t >= stream.from * (1 - same_event) && t <= stream.until * (1 + same_event);
}

}  // namespace

Schedule::Schedule(double end, double history_every, double frame_every, double checkpoint_every)
    : end_(end), streams_{{history_every}, {frame_every}, {checkpoint_every}} {}

int Schedule::add(EventStream stream) {
  streams_.push_back(stream);
  return static_cast<int>(streams_.size()) - 1;
}

bool Schedule::due(int stream, double t) const {
  const EventStream& events = streams_[static_cast<std::size_t>(stream)];
  if (!in_window(events, t)) return false;
  const bool edge = t == 0 || at_end(t);
  if (stream == checkpoint_stream && t == 0) return false;
  if (stream != checkpoint_stream && edge) return true;
  const double every = events.every;
  if (!(every > 0)) return false;
  return std::abs(t - std::round(t / every) * every) <= same_event * every;
}

bool Schedule::record_due(double t) const {
  for (int stream = 0; stream < static_cast<int>(streams_.size()); ++stream) {
    if (stream != checkpoint_stream && due(stream, t)) return true;
  }
  return false;
}

double Schedule::event(int stream, double t) const {
  if (at_end(t)) return end_;
  const double every = streams_[static_cast<std::size_t>(stream)].every;
  return every > 0 ? std::round(t / every) * every : 0;
}

std::size_t Schedule::count(int stream) const {
  const EventStream& events = streams_[static_cast<std::size_t>(stream)];
  const double last = std::min(events.until, end_);
  if (!(events.every > 0) || last < events.from) return 2;
  constexpr double most = 1e9;  // nobody records more; a count stays a count
  const double multiples = std::ceil((last - events.from) / events.every * (1 - same_event));
  return static_cast<std::size_t>(std::min(most, multiples)) + 1;
}

bool Schedule::at_end(double t) const { return std::abs(t - end_) <= same_event * end_; }

double Schedule::next_event(double t) const {
  double next = end_;
  for (const EventStream& stream : streams_) {
    if (!(stream.every > 0)) continue;
    const double event = next_of(stream, t);
    // An event just before the end is the end.
    if (event < end_ - same_event * end_ && in_window(stream, event)) next = std::min(next, event);
  }
  return next;
}

}  // namespace scree
