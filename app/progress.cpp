// SPDX-License-Identifier: Apache-2.0
#include "app/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace scree {

namespace {

constexpr double bar_interval = 0.1;  // s of wall time between two drawings
constexpr double line_interval = 60;  // s of wall time after which a line is written anyway
constexpr double lines_a_run = 10;    // a line at every tenth of the simulated time
constexpr double line_spacing = 1;    // s of wall time between two lines at least
constexpr int bar_width = 24;         // characters
constexpr int least_bar_width = 6;

/// How many parts of the simulated time are over; the addend forgives rounding.
double part(double fraction) { return std::floor(fraction * lines_a_run + 1e-9); }

/// "[###...] " of so many characters inside the brackets; nothing where too few are left.
std::string bar(double fraction, int width) {
  if (width < least_bar_width) return {};
  const auto full = static_cast<std::size_t>(std::lround(fraction * width));
  return "[" + std::string(full, '#') + std::string(static_cast<std::size_t>(width) - full, '.') +
         "] ";
}

/// Columns of the terminal; many where they are unknown.
int columns(std::FILE* out) {
  winsize size{};
  const bool known = ioctl(fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 1000;
}

}  // namespace

Progress::Progress(std::FILE* out, ProgressStyle style, double start, double end, Clock clock)
    : out_(out), style_(style), start_(start), end_(end), clock_(std::move(clock)) {
  started_ = last_written_ = clock_();
  last_fraction_ = end_ > 0 ? start_ / end_ : 1;
}

bool Progress::due(double now, double fraction) const {
  const double waited = now - last_written_;
  if (style_ == ProgressStyle::bar) return waited >= bar_interval;
  return waited >= line_interval ||
         (waited >= line_spacing && part(fraction) > part(last_fraction_));
}

std::string Progress::text(const ProgressState& state, double now) const {
  const double wall = std::max(now - started_, 1e-9);
  const double speed = (state.time - start_) / wall;  // simulated seconds a second
  const double fraction = std::clamp(end_ > 0 ? state.time / end_ : 1.0, 0.0, 1.0);
  const std::string left = speed > 0 ? clock_text((end_ - state.time) / speed) : "-";
  return fmt::format(
      "{:3.0f} %  t {:.4g} / {:.4g} s  step {}  dt {:.2e} s  {:.2e} updates/s  ETA {}",
      std::floor(100 * fraction), state.time, end_, state.step, state.dt, state.updates / wall,
      left);
}

void Progress::write(const ProgressState& state, double now) {
  const double fraction = std::clamp(end_ > 0 ? state.time / end_ : 1.0, 0.0, 1.0);
  if (style_ == ProgressStyle::bar) {
    // Back to the line's start, and clear what a longer text left. A line that wraps could not be
    // redrawn: the bar shrinks, and then the text is cut.
    const std::string words = text(state, now);
    const int room = columns(out_) - 1;
    const int width = std::min(bar_width, room - static_cast<int>(words.size()) - 3);
    const std::string line = bar(fraction, width) + words;
    fmt::print(out_, "\r{}\x1b[K", line.substr(0, static_cast<std::size_t>(room)));
  } else {
    fmt::print(out_, "{}\n", text(state, now));
  }
  std::fflush(out_);
  last_written_ = now;
  last_fraction_ = fraction;
}

void Progress::update(const ProgressState& state) {
  if (style_ == ProgressStyle::none) return;
  const double now = clock_();
  if (due(now, end_ > 0 ? state.time / end_ : 1)) write(state, now);
}

void Progress::finish(const ProgressState& state) {
  if (style_ != ProgressStyle::bar) return;
  write(state, clock_());
  fmt::print(out_, "\n");
  std::fflush(out_);
}

std::string clock_text(double seconds) {
  if (!(seconds < 1e9)) return "-";
  const auto total = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  const long hours = total / 3600;
  if (hours == 0) return fmt::format("{}:{:02}", total / 60, total % 60);
  return fmt::format("{}:{:02}:{:02}", hours, total / 60 % 60, total % 60);
}

ProgressStyle progress_style(std::FILE* out, bool quiet) {
  if (quiet) return ProgressStyle::none;
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal && std::string_view(terminal) == "dumb";
  return isatty(fileno(out)) && !dumb ? ProgressStyle::bar : ProgressStyle::lines;
}

}  // namespace scree
