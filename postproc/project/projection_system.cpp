// SPDX-License-Identifier: Apache-2.0
#include "postproc/project/projection_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree {
namespace {

using Place = std::array<std::int64_t, 3>;

/// The multilinear functions of a cell's corners (bit a of the corner: its side along axis a) and
/// their gradients [1/m].
struct Corners {
  int count = 8;
  std::array<double, 8> value{};
  std::array<std::array<double, 3>, 8> gradient{};
};

Corners corners_at(const Lattice& lattice, const std::array<double, 3>& share) {
  Corners result;
  result.count = 1 << lattice.dimension;
  for (int c = 0; c < result.count; ++c) {
    const auto at = static_cast<std::size_t>(c);
    double product = 1;
    result.gradient[at].fill(1 / lattice.spacing);
    for (int a = 0; a < lattice.dimension; ++a) {
      const double f = share[static_cast<std::size_t>(a)];
      const bool upper = (c >> a & 1) != 0;
      product *= upper ? f : 1 - f;
      for (int b = 0; b < lattice.dimension; ++b) {
        const double factor = a == b ? (upper ? 1 : -1) : (upper ? f : 1 - f);
        result.gradient[at][static_cast<std::size_t>(b)] *= factor;
      }
    }
    result.value[at] = product;
  }
  return result;
}

Place corner_node(const Place& cell, int corner) {
  return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1)};
}

/// Neighbours of a node in the matrix: the 3^3 around it and the second ones along the axes.
constexpr int near_slots = 27, slots = 33;

int slot_of(const Place& from, const Place& to) {
  int code = 0;
  for (int a = 2; a >= 0; --a) {
    const auto at = static_cast<std::size_t>(a);
    const std::int64_t d = to[at] - from[at];
    if (d == 2 || d == -2) return near_slots + 2 * a + (d > 0);
    code = 3 * code + static_cast<int>(d) + 1;
  }
  return code;
}

Place slot_place(const Place& from, int slot) {
  Place to = from;
  if (slot >= near_slots) {
    to[static_cast<std::size_t>((slot - near_slots) / 2)] += slot % 2 == near_slots % 2 ? -2 : 2;
    return to;
  }
  for (std::size_t a = 0; a < 3; ++a, slot /= 3) to[a] += slot % 3 - 1;
  return to;
}

}  // namespace

/// The coefficients of this part's rows, each at its neighbour's slot.
struct ProjectionSystem::Assembly {
  std::int64_t first = 0, last = 0;  ///< unknowns of this part
  std::vector<double> coefficients;

  bool owns(std::int64_t unknown) const { return unknown >= first && unknown < last; }
  double& at(std::int64_t unknown, int slot) {
    return coefficients[static_cast<std::size_t>((unknown - first) * slots + slot)];
  }
};

ProjectionSystem::ProjectionSystem(const Lattice& lattice, const WeightedPoints& points,
                                   const ProjectionTerms& terms, int part, int parts)
    : lattice_(lattice), points_(points) {
  sort_points(lattice);
  number_nodes();
  Assembly assembly;
  const auto total = static_cast<std::int64_t>(nodes_.size());
  assembly.first = total * part / parts;
  assembly.last = total * (part + 1) / parts;
  assembly.coefficients.assign(static_cast<std::size_t>((assembly.last - assembly.first) * slots),
                               0.0);
  add_points(assembly, terms);
  if (terms.stabilization > 0) {
    add_jumps(assembly, terms.stabilization * std::pow(lattice.spacing, lattice.dimension));
  }
  compress(assembly);
}

void ProjectionSystem::sort_points(const Lattice& lattice) {
  cell_of_.assign(points_.count(), -1);
  std::vector<std::size_t> count(static_cast<std::size_t>(lattice.cell_count()) + 1, 0);
  for (std::size_t p = 0; p < points_.count(); ++p) {
    const LatticePlace place = locate(lattice, &points_.position[3 * p]);
    if (!place.inside) {
      ++outside_;
      continue;
    }
    cell_of_[p] = lattice.cell(place.cell);
    ++count[static_cast<std::size_t>(cell_of_[p]) + 1];
  }
  active_.assign(count.size() - 1, 0);
  for (std::size_t c = 0; c + 1 < count.size(); ++c) {
    if (count[c + 1] > 0) {
      active_[c] = 1;
      cells_.push_back(static_cast<std::int64_t>(c));
      first_.push_back(count[c]);
    }
    count[c + 1] += count[c];
  }
  first_.push_back(count.back());
  order_.resize(count.back());
  for (std::size_t p = 0; p < points_.count(); ++p) {
    if (cell_of_[p] >= 0) order_[count[static_cast<std::size_t>(cell_of_[p])]++] = p;
  }
}

void ProjectionSystem::number_nodes() {
  unknown_.assign(static_cast<std::size_t>(lattice_.node_count()), -1);
  const int corners = 1 << lattice_.dimension;
  for (const std::int64_t cell : cells_) {
    const Place place = lattice_.cell_place(cell);
    for (int c = 0; c < corners; ++c) {
      unknown_[static_cast<std::size_t>(lattice_.node(corner_node(place, c)))] = 0;
    }
  }
  for (std::size_t n = 0; n < unknown_.size(); ++n) {
    if (unknown_[n] < 0) continue;
    unknown_[n] = static_cast<std::int64_t>(nodes_.size());
    nodes_.push_back(static_cast<std::int64_t>(n));
  }
}

void ProjectionSystem::add_points(Assembly& assembly, const ProjectionTerms& terms) const {
  const double square = terms.smoothing_length * terms.smoothing_length;
  const int corners = 1 << lattice_.dimension;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Place place = lattice_.cell_place(cells_[c]);
    std::array<std::int64_t, 8> unknown{};
    bool touches = false;
    for (int i = 0; i < corners; ++i) {
      const auto node = static_cast<std::size_t>(lattice_.node(corner_node(place, i)));
      unknown[static_cast<std::size_t>(i)] = unknown_[node];
      touches = touches || assembly.owns(unknown_[node]);
    }
    if (!touches) continue;
    std::array<std::array<double, 8>, 8> matrix{};
    for (std::size_t k = first_[c]; k < first_[c + 1]; ++k) {
      const std::size_t p = order_[k];
      const Corners at = corners_at(lattice_, locate(lattice_, &points_.position[3 * p]).share);
      for (std::size_t i = 0; i < static_cast<std::size_t>(corners); ++i) {
        for (std::size_t j = 0; j < static_cast<std::size_t>(corners); ++j) {
          double sum = at.value[i] * at.value[j];
          for (std::size_t a = 0; square > 0 && a < static_cast<std::size_t>(lattice_.dimension);
               ++a) {
            sum += square * at.gradient[i][a] * at.gradient[j][a];
          }
          matrix[i][j] += points_.weight[p] * sum;
        }
      }
    }
    for (int i = 0; i < corners; ++i) {
      const std::int64_t row = unknown[static_cast<std::size_t>(i)];
      if (!assembly.owns(row)) continue;
      for (int j = 0; j < corners; ++j) {
        const int slot = slot_of(corner_node(place, i), corner_node(place, j));
        assembly.at(row, slot) += matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      }
    }
  }
}

bool ProjectionSystem::active(const Place& cell) const {
  for (std::size_t a = 0; a < static_cast<std::size_t>(lattice_.dimension); ++a) {
    if (cell[a] < 0 || cell[a] >= lattice_.cells[a]) return false;
  }
  return active_[static_cast<std::size_t>(lattice_.cell(cell))] != 0;
}

bool ProjectionSystem::at_edge(const Place& cell) const {
  for (std::size_t a = 0; a < static_cast<std::size_t>(lattice_.dimension); ++a) {
    for (const int step : {-1, 1}) {
      Place next = cell;
      next[a] += step;
      if (!active(next)) return true;
    }
  }
  return false;
}

void ProjectionSystem::add_jumps(Assembly& assembly, double weight) const {
  for (const std::int64_t index : cells_) {
    const Place cell = lattice_.cell_place(index);
    for (int axis = 0; axis < lattice_.dimension; ++axis) {
      Place next = cell;
      ++next[static_cast<std::size_t>(axis)];
      if (active(next) && (at_edge(cell) || at_edge(next))) add_jump(assembly, cell, axis, weight);
    }
  }
}

/// The face between a cell and its upper neighbour: at each of its nodes the jump of the normal
/// derivative, times h, is the second difference across it.
void ProjectionSystem::add_jump(Assembly& assembly, const Place& cell, int axis,
                                double weight) const {
  static constexpr std::array<double, 3> difference = {1, -2, 1};
  const int corners = 1 << lattice_.dimension;
  const double share = weight / (corners / 2);
  for (int corner = 0; corner < corners; ++corner) {
    if ((corner >> axis & 1) != 0) continue;
    std::array<Place, 3> line{};
    for (std::size_t i = 0; i < 3; ++i) {
      line[i] = corner_node(cell, corner);
      line[i][static_cast<std::size_t>(axis)] += static_cast<std::int64_t>(i);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t row = unknown_[static_cast<std::size_t>(lattice_.node(line[i]))];
      if (!assembly.owns(row)) continue;
      for (std::size_t j = 0; j < 3; ++j) {
        assembly.at(row, slot_of(line[i], line[j])) += share * difference[i] * difference[j];
      }
    }
  }
}

void ProjectionSystem::compress(const Assembly& assembly) {
  matrix_.first = assembly.first;
  matrix_.size = static_cast<std::int64_t>(nodes_.size());
  std::vector<std::pair<std::int64_t, double>> row;
  for (std::int64_t r = assembly.first; r < assembly.last; ++r) {
    const Place place = lattice_.node_place(nodes_[static_cast<std::size_t>(r)]);
    row.clear();
    for (int slot = 0; slot < slots; ++slot) {
      const double value =
          assembly.coefficients[static_cast<std::size_t>((r - assembly.first) * slots + slot)];
      if (value == 0) continue;
      const std::int64_t node = lattice_.node(slot_place(place, slot));
      row.emplace_back(unknown_[static_cast<std::size_t>(node)], value);
    }
    std::sort(row.begin(), row.end());
    for (const auto& [column, value] : row) {
      matrix_.column.push_back(column);
      matrix_.value.push_back(value);
    }
    matrix_.start.push_back(static_cast<std::int64_t>(matrix_.column.size()));
  }
}

std::vector<double> ProjectionSystem::right_hand_side(const std::vector<double>& values) const {
  const std::int64_t first = matrix_.first, last = first + matrix_.rows();
  std::vector<double> result(static_cast<std::size_t>(matrix_.rows()), 0.0);
  for (std::size_t p = 0; p < points_.count(); ++p) {
    if (cell_of_[p] < 0) continue;
    const Place place = lattice_.cell_place(cell_of_[p]);
    const Corners at = corners_at(lattice_, locate(lattice_, &points_.position[3 * p]).share);
    for (int i = 0; i < at.count; ++i) {
      const auto node = static_cast<std::size_t>(lattice_.node(corner_node(place, i)));
      const std::int64_t row = unknown_[node];
      if (row < first || row >= last) continue;
      result[static_cast<std::size_t>(row - first)] +=
          points_.weight[p] * values[p] * at.value[static_cast<std::size_t>(i)];
    }
  }
  return result;
}

std::vector<double> ProjectionSystem::node_volumes() const {
  return right_hand_side(std::vector<double>(points_.count(), 1.0));
}

double interpolate(const Lattice& lattice, const std::vector<double>& node_values,
                   const double* point) {
  const LatticePlace place = locate(lattice, point);
  const Corners at = corners_at(lattice, place.share);
  double sum = 0;
  for (int i = 0; i < at.count; ++i) {
    const auto node = static_cast<std::size_t>(lattice.node(corner_node(place.cell, i)));
    sum += at.value[static_cast<std::size_t>(i)] * node_values[node];
  }
  return sum;
}

}  // namespace scree
