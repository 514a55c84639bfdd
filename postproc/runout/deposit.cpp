// SPDX-License-Identifier: Apache-2.0
#include "postproc/runout/deposit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace scree {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int sectors = 72;

/// The distance behind which the share of the volume lies.
double quantile(const std::vector<double>& distance, const std::vector<double>& volume,
                double share) {
  std::vector<std::size_t> order(distance.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
  const double total = std::accumulate(volume.begin(), volume.end(), 0.0);
  double sum = 0;
  for (const std::size_t p : order) {
    sum += volume[p];
    if (sum >= share * total * (1 - 1e-12)) return distance[p];
  }
  return distance.empty() ? 0 : distance[order.back()];
}

/// The horizontal axes, in order.
std::array<std::size_t, 2> horizontal(int up) {
  if (up == 0) return {1, 2};
  if (up == 1) return {0, 2};
  return {0, 1};
}

}  // namespace

double Measure::distance(const double* x) const {
  if (!radial) {
    const auto a = static_cast<std::size_t>(along.axis);
    return along.sign * (x[a] - origin[a]);
  }
  const auto [a, b] = horizontal(up.axis);
  return std::hypot(x[a] - origin[a], x[b] - origin[b]);
}

double Measure::height(const double* x) const {
  return up.sign * (x[static_cast<std::size_t>(up.axis)] - base);
}

std::vector<double> half_spacings(const Run& run, const ParticleSnapshot& particles) {
  std::vector<double> result;
  result.reserve(particles.body.size());
  for (const std::int32_t body : particles.body) {
    result.push_back(0.5 * run.bodies().at(static_cast<std::size_t>(body)).particle_spacing);
  }
  return result;
}

Extent measure(const Measure& measure, const WeightedFrame& frame,
               const std::vector<double>& half_spacing) {
  Extent extent;
  extent.time = frame.particles.time;
  extent.back = std::numeric_limits<double>::max();
  extent.height = extent.farthest = std::numeric_limits<double>::lowest();
  std::vector<double> outer(frame.count());
  double total = 0;
  for (std::size_t p = 0; p < frame.count(); ++p) {
    const double d = measure.distance(frame.place(p)), h = measure.height(frame.place(p));
    outer[p] = d + half_spacing[p];
    extent.farthest = std::max(extent.farthest, outer[p]);
    extent.back = std::min(extent.back, d - half_spacing[p]);
    extent.height = std::max(extent.height, h + half_spacing[p]);
    extent.centre += frame.volume[p] * d;
    extent.centre_height += frame.volume[p] * h;
    total += frame.volume[p];
  }
  extent.centre /= total;
  extent.centre_height /= total;
  extent.front = quantile(outer, frame.volume, measure.share);
  return extent;
}

std::vector<OutlinePoint> outline(const Measure& measure, const WeightedFrame& frame,
                                  const std::vector<double>& half_spacing, double width) {
  std::map<long, double> bins;
  const auto [a, b] = horizontal(measure.up.axis);
  for (std::size_t p = 0; p < frame.count(); ++p) {
    const double* x = frame.place(p);
    const double d = measure.distance(x);
    long bin = std::lround(std::floor(d / width));
    double value = measure.height(x) + half_spacing[p];
    if (measure.radial) {
      const double angle = std::atan2(x[b] - measure.origin[b], x[a] - measure.origin[a]);
      bin = std::min<long>(sectors - 1,
                           std::lround(std::floor((angle / (2 * pi) + (angle < 0)) * sectors)));
      value = d + half_spacing[p];
    }
    const auto [at, fresh] = bins.emplace(bin, value);
    if (!fresh) at->second = std::max(at->second, value);
  }
  std::vector<OutlinePoint> result;
  for (const auto& [bin, value] : bins) {
    const double middle = static_cast<double>(bin) + 0.5;
    result.push_back({measure.radial ? middle * 360 / sectors : middle * width, value});
  }
  return result;
}

}  // namespace scree
