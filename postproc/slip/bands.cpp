// SPDX-License-Identifier: Apache-2.0
#include "postproc/slip/bands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "solver/base/eigen.hpp"

namespace scree {
namespace {

using Place = std::array<long, 3>;
constexpr double degrees = 180 / 3.14159265358979323846;

std::array<double, 3> centre_of(const Run& run, const Place& at, double spacing) {
  std::array<double, 3> x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(run.dimension()); ++a) {
    x[a] = run.lower()[a] + spacing * (static_cast<double>(at[a]) + 0.5);
  }
  return x;
}

/// The cells of one band and the way through them.
class Band {
 public:
  Band(const Run& run, const CellField& field, std::vector<std::size_t> members)
      : run_(run), field_(field), members_(std::move(members)) {
    for (std::size_t i = 0; i < members_.size(); ++i) index_[cell(i).at] = i;
  }

  ShearBand measure() const {
    ShearBand band;
    band.cells = members_.size();
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const auto x = place(i);
      for (std::size_t a = 0; a < 3; ++a) band.centre[a] += cell(i).volume * x[a];
      band.volume += cell(i).volume;
      band.mean += cell(i).volume * cell(i).mean;
      band.largest = std::max(band.largest, cell(i).mean);
    }
    for (double& x : band.centre) x /= band.volume;
    band.mean /= band.volume;
    add_skeleton(band);
    add_direction(band);
    return band;
  }

 private:
  const CellField::Cell& cell(std::size_t i) const { return field_.cells[members_[i]]; }
  std::array<double, 3> place(std::size_t i) const {
    return centre_of(run_, cell(i).at, field_.spacing);
  }

  /// Shortest ways from a cell to all others (Dijkstra), in cells; returns the farthest.
  std::size_t farthest(std::size_t from, double& distance) const {
    std::vector<double> way(members_.size(), std::numeric_limits<double>::max());
    using Item = std::pair<double, std::size_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
    way[from] = 0;
    open.push({0, from});
    std::size_t last = from;
    while (!open.empty()) {
      const auto [length, i] = open.top();
      open.pop();
      if (length > way[i]) continue;
      last = i;
      for (const auto& [j, step] : neighbours(i)) {
        if (length + step >= way[j]) continue;
        way[j] = length + step;
        open.push({way[j], j});
      }
    }
    distance = way[last];
    return last;
  }

  std::vector<std::pair<std::size_t, double>> neighbours(std::size_t i) const {
    std::vector<std::pair<std::size_t, double>> result;
    const int depth = run_.dimension() == 3 ? 1 : 0;
    for (int dz = -depth; dz <= depth; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Place& at = cell(i).at;
          const auto found = index_.find({at[0] + dx, at[1] + dy, at[2] + dz});
          if (found == index_.end() || found->second == i) continue;
          result.emplace_back(found->second, std::sqrt(double(dx * dx + dy * dy + dz * dz)));
        }
      }
    }
    return result;
  }

  /// From any cell to the farthest, and from there to the farthest again: the two ends.
  void add_skeleton(ShearBand& band) const {
    double ignored = 0, length = 0;
    const std::size_t first = farthest(0, ignored);
    const std::size_t last = farthest(first, length);
    band.first = place(first);
    band.last = place(last);
    band.length = field_.spacing * (length + 1);  // the halves of the end cells
  }

  /// Main axes of the band's volume: the longest gives the angle in 2D; in 3D the shortest is the
  /// normal of the plane. A flat layer's spread is its thickness over sqrt(12).
  void add_direction(ShearBand& band) const {
    Sym3<double> spread{};
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const auto x = place(i);
      const double w = cell(i).volume / band.volume;
      const double d[3] = {x[0] - band.centre[0], x[1] - band.centre[1], x[2] - band.centre[2]};
      spread.xx += w * d[0] * d[0];
      spread.xy += w * d[0] * d[1];
      spread.xz += w * d[0] * d[2];
      spread.yy += w * d[1] * d[1];
      spread.yz += w * d[1] * d[2];
      spread.zz += w * d[2] * d[2];
    }
    const SymEigen<double> axes = eigen_symmetric(spread);
    const double values[3] = {axes.values[0], axes.values[1], axes.values[2]};
    const auto up = run_.up().axis;
    if (run_.dimension() == 2) {
      int longest = 0;
      for (int i = 1; i < 3; ++i) longest = values[i] > values[longest] ? i : longest;
      const double rise = axes.vectors(up, longest), run = axes.vectors(1 - up, longest);
      band.angle = degrees * std::atan2(run < 0 ? -rise : rise, std::abs(run));
      band.thickness = band.volume / band.length;
      return;
    }
    int shortest = 0;
    for (int i = 1; i < 3; ++i) shortest = values[i] < values[shortest] ? i : shortest;
    band.angle = degrees * std::acos(std::min(1.0, std::abs(axes.vectors(up, shortest))));
    const double own = field_.spacing * field_.spacing / 12;  // the cells' own extent
    band.thickness = std::sqrt(12 * (std::max(0.0, values[shortest]) + own));
  }

  const Run& run_;
  const CellField& field_;
  std::vector<std::size_t> members_;
  std::map<Place, std::size_t> index_;
};

}  // namespace

CellField cell_field(const Run& run, const WeightedFrame& frame, const std::vector<double>& values,
                     double spacing) {
  std::map<Place, std::pair<double, double>> sums;
  for (std::size_t p = 0; p < frame.count(); ++p) {
    if (!std::isfinite(values[p])) continue;
    Place at{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(run.dimension()); ++a) {
      at[a] = std::lround(std::floor((frame.place(p)[a] - run.lower()[a]) / spacing));
    }
    auto& [volume, sum] = sums[at];
    volume += frame.volume[p];
    sum += frame.volume[p] * values[p];
  }
  CellField field;
  field.spacing = spacing;
  for (const auto& [at, sum] : sums) {
    field.cells.push_back({at, sum.second / sum.first, sum.first});
  }
  return field;
}

double default_threshold(const CellField& field) {
  std::vector<double> values;
  for (const CellField::Cell& cell : field.cells) values.push_back(cell.mean);
  if (values.empty()) return 0;
  const std::size_t at = (values.size() - 1) * 99 / 100;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return 0.5 * values[at];
}

std::vector<ShearBand> shear_bands(const Run& run, const CellField& field, double threshold,
                                   std::size_t least) {
  std::map<Place, std::size_t> open;
  for (std::size_t c = 0; c < field.cells.size(); ++c) {
    if (field.cells[c].mean > threshold) open[field.cells[c].at] = c;
  }
  std::vector<ShearBand> bands;
  const int depth = run.dimension() == 3 ? 1 : 0;
  while (!open.empty()) {
    std::vector<std::size_t> members;
    std::vector<std::size_t> next{open.begin()->second};
    open.erase(open.begin());
    while (!next.empty()) {
      const std::size_t c = next.back();
      next.pop_back();
      members.push_back(c);
      const Place at = field.cells[c].at;
      for (int n = 0; n < (depth > 0 ? 27 : 9); ++n) {
        const Place beside{at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + depth * (n / 9 - 1)};
        const auto found = open.find(beside);
        if (found == open.end()) continue;
        next.push_back(found->second);
        open.erase(found);
      }
    }
    if (members.size() >= least) bands.push_back(Band(run, field, std::move(members)).measure());
  }
  std::sort(bands.begin(), bands.end(),
            [](const ShearBand& a, const ShearBand& b) { return a.volume > b.volume; });
  return bands;
}

}  // namespace scree
