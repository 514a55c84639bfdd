// SPDX-License-Identifier: Apache-2.0
#include "postproc/surface/level_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {
namespace {

/// Whether a coordinate is that of a face of the domain, to rounding.
bool at_face(const Run& run, std::size_t axis, double x, double spacing) {
  return std::abs(x - run.lower()[axis]) < 1e-6 * spacing ||
         std::abs(x - run.upper()[axis]) < 1e-6 * spacing;
}

Lattice around(const Run& run, const WeightedFrame& frame, double spacing) {
  Lattice lattice;
  lattice.dimension = run.dimension();
  lattice.spacing = spacing;
  for (std::size_t a = 0; a < static_cast<std::size_t>(run.dimension()); ++a) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (std::size_t p = 0; p < frame.count(); ++p) {
      low = std::min(low, frame.place(p)[a]);
      high = std::max(high, frame.place(p)[a]);
    }
    const double first = std::floor((low - run.lower()[a]) / spacing) - 2;
    const double last = std::ceil((high - run.lower()[a]) / spacing) + 2;
    lattice.origin[a] = run.lower()[a] + spacing * first;
    lattice.cells[a] = std::llround(last - first);
  }
  return lattice;
}

}  // namespace

LevelSet volume_fraction(const Run& run, const WeightedFrame& frame, double spacing) {
  LevelSet level;
  level.lattice = around(run, frame, spacing);
  const Lattice& lattice = level.lattice;
  level.fraction.assign(static_cast<std::size_t>(lattice.node_count()), 0.0);
  const double cell = std::pow(spacing, lattice.dimension);
  for (std::size_t p = 0; p < frame.count(); ++p) {
    const LatticePlace place = locate(lattice, frame.place(p));
    for (int corner = 0; corner < 1 << lattice.dimension; ++corner) {
      std::array<std::int64_t, 3> node = place.cell;
      double weight = frame.volume[p] / cell;
      for (int a = 0; a < lattice.dimension; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        const int upper = corner >> a & 1;
        node[axis] += upper;
        weight *= upper != 0 ? place.share[axis] : 1 - place.share[axis];
      }
      level.fraction[static_cast<std::size_t>(lattice.node(node))] += weight;
    }
  }
  for (std::int64_t n = 0; n < lattice.node_count(); ++n) {
    const auto at = lattice.node_place(n);
    for (std::size_t a = 0; a < static_cast<std::size_t>(lattice.dimension); ++a) {
      const double x = lattice.origin[a] + spacing * static_cast<double>(at[a]);
      if (at_face(run, a, x, spacing)) level.fraction[static_cast<std::size_t>(n)] *= 2;
    }
  }
  return level;
}

std::vector<SurfacePoint> free_surface(const LevelSet& level, Direction up) {
  const Lattice& lattice = level.lattice;
  const auto axis = static_cast<std::size_t>(up.axis);
  const std::int64_t count = lattice.nodes(up.axis);
  std::vector<SurfacePoint> points;
  for (std::int64_t n = 0; n < lattice.node_count(); ++n) {
    std::array<std::int64_t, 3> at = lattice.node_place(n);
    if (at[axis] != 0) continue;  // one visit a line
    double above = 0;
    for (std::int64_t i = 0; i < count; ++i) {
      at[axis] = up.sign > 0 ? count - 1 - i : i;
      const double here = level.fraction[static_cast<std::size_t>(lattice.node(at))];
      if (here >= 0.5 && above < 0.5) {
        SurfacePoint point;
        for (std::size_t a = 0; a < 3; ++a) {
          point.place[a] = lattice.origin[a] + lattice.spacing * static_cast<double>(at[a]);
        }
        point.place[axis] += up.sign * lattice.spacing * (here - 0.5) / (here - above);
        point.height = up.sign * point.place[axis];
        points.push_back(point);
        break;
      }
      above = here;
    }
  }
  return points;
}

}  // namespace scree
