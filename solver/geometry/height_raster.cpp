// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/height_raster.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace scree {

HeightRaster::HeightRaster(int columns, int rows, std::array<double, 2> center, double cell_size,
                           std::vector<double> height)
    : columns_(columns),
      rows_(rows),
      center_(center),
      cell_size_(cell_size),
      height_(std::move(height)) {}

std::array<double, 2> HeightRaster::lower() const {
  return {center_[0] - 0.5 * cell_size_, center_[1] - 0.5 * cell_size_};
}

std::array<double, 2> HeightRaster::upper() const {
  return {center_[0] + (columns_ - 0.5) * cell_size_, center_[1] + (rows_ - 0.5) * cell_size_};
}

double HeightRaster::lowest() const { return *std::min_element(height_.begin(), height_.end()); }

double HeightRaster::highest() const { return *std::max_element(height_.begin(), height_.end()); }

std::array<double, 2> HeightRaster::lowest_place() const {
  const auto k = std::min_element(height_.begin(), height_.end()) - height_.begin();
  const auto row = k / columns_;
  return {center_[0] + double(k % columns_) * cell_size_, center_[1] + double(row) * cell_size_};
}

double HeightRaster::height(double x, double y, double slope[2]) const {
  const double u = std::clamp((x - center_[0]) / cell_size_, 0.0, double(columns_ - 1));
  const double v = std::clamp((y - center_[1]) / cell_size_, 0.0, double(rows_ - 1));
  const int i = std::clamp(int(u), 0, std::max(columns_ - 2, 0));
  const int j = std::clamp(int(v), 0, std::max(rows_ - 2, 0));
  const int east = std::min(i + 1, columns_ - 1), north = std::min(j + 1, rows_ - 1);
  const double a = u - i, b = v - j;
  const double south_edge = at(i, j) + a * (at(east, j) - at(i, j));
  const double north_edge = at(i, north) + a * (at(east, north) - at(i, north));
  if (slope != nullptr) {
    const bool within[2] = {u > 0 && u<columns_ - 1, v> 0 && v < rows_ - 1};
    const double south_rise = at(east, j) - at(i, j);
    const double north_rise = at(east, north) - at(i, north);
    slope[0] = within[0] ? (south_rise + b * (north_rise - south_rise)) / cell_size_ : 0;
    slope[1] = within[1] ? (north_edge - south_edge) / cell_size_ : 0;
  }
  return south_edge + b * (north_edge - south_edge);
}

double HeightRaster::steepest() const {
  double square = 0;
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      const int east = std::min(i + 1, columns_ - 1), north = std::min(j + 1, rows_ - 1);
      const double along =
          std::max(std::abs(at(east, j) - at(i, j)), std::abs(at(east, north) - at(i, north)));
      const double across =
          std::max(std::abs(at(i, north) - at(i, j)), std::abs(at(east, north) - at(east, j)));
      square = std::max(square, along * along + across * across);
    }
  return std::sqrt(square) / cell_size_;
}

double HeightRaster::integral() const {
  // The share of each height is a tent over its neighbours; at the rim the constant continuation
  // makes up for the missing half. So each one counts with the area of its cell.
  return std::accumulate(height_.begin(), height_.end(), 0.0) * cell_size_ * cell_size_;
}

HeightProfile::HeightProfile(const HeightRaster& raster, const std::array<double, 2>& from,
                             const std::array<double, 2>& to) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const std::array<double, 2> direction{(to[0] - from[0]) / length, (to[1] - from[1]) / length};
  std::vector<double> places{0, length};
  for (std::size_t a = 0; a < 2; ++a) {
    const int count = a == 0 ? raster.columns() : raster.rows();
    for (int i = 0; i < count && direction[a] != 0; ++i) {
      const double s = (raster.center()[a] + i * raster.cell_size() - from[a]) / direction[a];
      if (s > 0 && s < length) places.push_back(s);
    }
  }
  cut(raster, from, direction, std::move(places));
}

HeightProfile::HeightProfile(const HeightRaster& row) {
  const double first = row.lower()[0];
  std::vector<double> places{first, row.upper()[0]};
  for (int i = 0; i < row.columns(); ++i) places.push_back(row.center()[0] + i * row.cell_size());
  cut(row, {0, row.center()[1]}, {1, 0}, std::move(places));
}

/// A parabola between neighbouring places through three heights: exact.
void HeightProfile::cut(const HeightRaster& raster, const std::array<double, 2>& from,
                        const std::array<double, 2>& direction, std::vector<double> places) {
  std::sort(places.begin(), places.end());
  const double tiny = 1e-9 * (places.back() - places.front());
  for (const double s : places)
    if (s_.empty() || s - s_.back() > tiny) s_.push_back(s);
  s_.back() = places.back();
  const auto height = [&](double s) {
    return raster.height(from[0] + s * direction[0], from[1] + s * direction[1]);
  };
  for (std::size_t k = 0; k + 1 < s_.size(); ++k) {
    const double width = s_[k + 1] - s_[k];
    const double a = height(s_[k]), b = height(s_[k] + 0.5 * width), c = height(s_[k + 1]);
    const double bend = 2 * (a - 2 * b + c) / (width * width);
    pieces_.push_back({a, (c - a) / width - bend * width, bend});
  }
}

double HeightProfile::height(double s, double* slope) const {
  const double at = std::clamp(s, s_.front(), s_.back());
  const auto next = std::upper_bound(s_.begin() + 1, s_.end() - 1, at);
  const std::size_t k = std::size_t(next - s_.begin()) - 1;
  const Piece& piece = pieces_[k];
  const double d = at - s_[k];
  if (slope != nullptr) *slope = piece.slope + 2 * piece.bend * d;
  return piece.value + d * (piece.slope + d * piece.bend);
}

double HeightProfile::highest() const {
  double most = height(s_.back());
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    most = std::max(most, pieces_[k].value);
    if (!(pieces_[k].bend < 0)) continue;
    const double top =
        std::clamp(-pieces_[k].slope / (2 * pieces_[k].bend), 0.0, s_[k + 1] - s_[k]);
    most = std::max(most, height(s_[k] + top));
  }
  return most;
}

double HeightProfile::lowest() const {
  double least = height(s_.back());
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    least = std::min(least, pieces_[k].value);
    if (!(pieces_[k].bend > 0)) continue;
    const double dip =
        std::clamp(-pieces_[k].slope / (2 * pieces_[k].bend), 0.0, s_[k + 1] - s_[k]);
    least = std::min(least, height(s_[k] + dip));
  }
  return least;
}

double HeightProfile::steepest() const {
  double most = 0;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const double end = pieces_[k].slope + 2 * pieces_[k].bend * (s_[k + 1] - s_[k]);
    most = std::max({most, std::abs(pieces_[k].slope), std::abs(end)});
  }
  return most;
}

double HeightProfile::integral() const {
  double sum = 0;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const double w = s_[k + 1] - s_[k];
    sum += w * (pieces_[k].value + w * (pieces_[k].slope / 2 + w * pieces_[k].bend / 3));
  }
  return sum;
}

void HeightProfile::move(double along, double up) {
  for (double& s : s_) s += along;
  for (Piece& piece : pieces_) piece.value += up;
}

}  // namespace scree
