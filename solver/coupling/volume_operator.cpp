// SPDX-License-Identifier: Apache-2.0
// Which velocity nodes touch which pressure nodes.
#include "solver/coupling/volume_operator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scree {

template <int D>
VolumeOperator<D>::VolumeOperator(const PressureLattice<D>& lattice, KernelType kernel,
                                  TransferType transfer, double cell_size)
    : lattice_(lattice),
      kernel_(kernel),
      transfer_(transfer),
      cell_size_(cell_size),
      width_(lattice.spacing() == 1 ? 4 : 3),
      hats_(power(width_, D)),
      stride_((hats_ + 3) / 4 * 4),
      lattices_(kernel == KernelType::compact ? 2 : 1),
      slots_(lattices_ * power(lattice.spacing(), D)),
      reach_(kernel == KernelType::quadratic ? 1.5 : 1.0) {
  const std::int64_t first = lattice.index({});
  for (int j = 0; j < hats_ && !lattice.periodic(); ++j) {
    hat_steps_.push_back(lattice.index(hat(j)) - first);
  }
}

/// The lowest node of a lattice, an axis, whose lowest hat is node 0 of the pressure.
template <int D>
std::int32_t VolumeOperator<D>::lowest_node(int lattice) const {
  return std::int32_t(std::ceil(reach_ + lattice_.offset() - 0.5 * lattice));
}

template <int D>
void VolumeOperator<D>::rebuild(const Topology<D>& topology) {
  constexpr int nodes = block_node_count<D>;
  const int spacing = lattice_.spacing();
  const std::size_t records = std::size_t(topology.size()) * std::size_t(lattices_) * nodes;
  std::vector<PressureNode<D>> base(records);
  std::vector<std::int32_t> slot(records);
  for (std::size_t r = 0; r < records; ++r) {
    const BlockCoord<D> block = topology.coord(int(r / std::size_t(lattices_ * nodes)));
    const int lattice = int(r / nodes) % lattices_;
    const int first = lowest_node(lattice);
    int local = int(r % nodes);
    int digits[D];
    for (int a = D - 1; a >= 0; --a) {
      const int node = block_cells * block[std::size_t(a)] + local % block_cells - first;
      const int b = node >= 0 ? node / spacing : -((spacing - 1 - node) / spacing);
      base[r][std::size_t(a)] = b;
      digits[a] = node - spacing * b;
      local /= block_cells;
    }
    slot[r] = lattice;
    for (int a = 0; a < D; ++a) slot[r] = slot[r] * spacing + digits[a];
  }
  number_groups(base);
  record_.assign(groups_.size() * std::size_t(slots_), -1);
  place_.resize(records);
  for (std::size_t r = 0; r < records; ++r) {
    place_[r] = find_group(base[r]) * slots_ + slot[r];
    record_[std::size_t(place_[r])] = std::int32_t(r);
  }
  find_pencils();
  q_.resize(record_.size() * std::size_t(D * stride_));
}

template <int D>
void VolumeOperator<D>::number_groups(const std::vector<PressureNode<D>>& base) {
  PressureNode<D> upper{};
  corner_.fill(0);
  for (std::size_t r = 0; r < base.size(); ++r) {
    for (std::size_t a = 0; a < D; ++a) {
      corner_[a] = r == 0 ? base[r][a] : std::min(corner_[a], base[r][a]);
      upper[a] = r == 0 ? base[r][a] : std::max(upper[a], base[r][a]);
    }
  }
  std::size_t size = 1;
  for (std::size_t a = 0; a < D; ++a) {
    extent_[a] = upper[a] - corner_[a] + 1;
    size *= std::size_t(extent_[a]);
  }
  group_at_.assign(size, -1);
  const auto at = [&](const PressureNode<D>& b) {
    std::size_t index = 0;
    for (std::size_t a = 0; a < D; ++a) {
      index = index * std::size_t(extent_[a]) + std::size_t(b[a] - corner_[a]);
    }
    return index;
  };
  for (const PressureNode<D>& b : base) group_at_[at(b)] = 0;
  groups_.clear();
  for (std::size_t i = 0; i < size; ++i) {
    if (group_at_[i] < 0) continue;
    group_at_[i] = std::int32_t(groups_.size());
    PressureNode<D> b = corner_;
    std::size_t rest = i;
    for (std::size_t a = D; a-- > 0; rest /= std::size_t(extent_[a])) {
      b[a] += std::int32_t(rest % std::size_t(extent_[a]));
    }
    groups_.push_back(b);
  }
}

/// Pencils of one colour differ by a multiple of width_ in an axis, so their hats are disjoint.
template <int D>
void VolumeOperator<D>::find_pencils() {
  pencils_.clear();
  colours_.assign(std::size_t(power(width_, D - 1)), {});
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    bool same = g > 0;
    std::size_t colour = 0;
    for (std::size_t a = 0; a + 1 < D; ++a) {
      same = same && groups_[g][a] == groups_[g - 1][a];
      colour = colour * std::size_t(width_) + std::size_t((groups_[g][a] - corner_[a]) % width_);
    }
    if (!same) {
      colours_[colour].push_back(std::int32_t(pencils_.size()));
      pencils_.emplace_back(std::int32_t(g), 0);
    }
    pencils_.back().second = std::int32_t(g) + 1;
  }
}

template <int D>
std::int32_t VolumeOperator<D>::find_group(const PressureNode<D>& base) const {
  std::size_t index = 0;
  for (std::size_t a = 0; a < D; ++a) {
    const std::int32_t at = base[a] - corner_[a];
    if (at < 0 || at >= extent_[a]) return -1;
    index = index * std::size_t(extent_[a]) + std::size_t(at);
  }
  return group_at_[index];
}

/// Q of a place, to be added to.
template <int D>
double* VolumeOperator<D>::touched(std::size_t place) {
  double* q = q_.data() + place * std::size_t(D * stride_);
  if (empty_[place] != 0) std::fill(q, q + D * stride_, 0.0);
  empty_[place] = 0;
  return q;
}

template <int D>
PressureNode<D> VolumeOperator<D>::hat(int j) const {
  PressureNode<D> node{};
  for (int a = D - 1; a >= 0; --a) {
    node[std::size_t(a)] = j % width_;
    j /= width_;
  }
  return node;
}

template <int D>
void VolumeOperator<D>::group_rows(std::size_t group, const PressureMatrix<D>& matrix,
                                   std::int32_t* rows) const {
  PressureNode<D> node = groups_[group];
  if (!hat_steps_.empty()) {
    const std::int64_t first = lattice_.index(node);
    for (int j = 0; j < hats_; ++j) rows[j] = matrix.row_at(first + hat_steps_[std::size_t(j)]);
    return;
  }
  for (int j = 0; j < hats_; ++j) {
    rows[j] = matrix.row(node);
    // Counts up, last axis fastest.
    for (std::size_t a = D; a-- > 0;) {
      if (++node[a] < groups_[group][a] + width_) break;
      node[a] = groups_[group][a];
    }
  }
}

template <int D>
void VolumeOperator<D>::rows(std::int64_t record, const PressureMatrix<D>& matrix,
                             std::vector<std::int32_t>& rows) const {
  rows.resize(std::size_t(hats_));
  group_rows(std::size_t(place_[std::size_t(record)] / slots_), matrix, rows.data());
}

/// Number among the hats of `root` of hat j of `ghost`; -1: it is none of them.
template <int D>
int VolumeOperator<D>::same_hat(std::int64_t root, std::int64_t ghost, int j) const {
  const PressureNode<D>& near = base(root);
  PressureNode<D> node = base(ghost);
  for (int a = D - 1; a >= 0; --a, j /= width_) node[std::size_t(a)] += j % width_;
  if (!lattice_.periodic()) {
    int at = 0;
    bool inside = true;
    for (std::size_t a = 0; a < D; ++a) {
      const int digit = node[a] - near[a];
      inside = inside && digit >= 0 && digit < width_;
      at = at * width_ + digit;
    }
    return inside ? at : -1;
  }
  const std::int64_t index = lattice_.index(node);
  for (int k = 0; k < hats_; ++k) {
    PressureNode<D> other = near;
    const PressureNode<D> step = hat(k);
    for (std::size_t a = 0; a < D; ++a) other[a] += step[a];
    if (lattice_.index(other) == index) return k;
  }
  return -1;
}

template <int D>
void VolumeOperator<D>::fold(std::int64_t root, std::int64_t ghost,
                             const std::array<std::int8_t, D>& sign) {
  if (keeps_unfolded_) {
    note_unfolded(root);
    note_unfolded(ghost);
  }
  for (std::size_t a = 0; a < D && !load_.empty(); ++a) {
    load_[std::size_t(root) * D + a] += sign[a] * load_[std::size_t(ghost) * D + a];
    load_[std::size_t(ghost) * D + a] = 0;
  }
  if (block(ghost) == nullptr) return;
  double* to = touched(std::size_t(place_[std::size_t(root)]));
  double* from = touched(std::size_t(place_[std::size_t(ghost)]));
  for (int j = 0; j < hats_; ++j) {
    bool any = false;
    for (int a = 0; a < D; ++a) any = any || from[a * stride_ + j] != 0;
    if (!any) continue;
    // What the ghost sees of the body lies within the root's reach too.
    const int at = same_hat(root, ghost, j);
    if (at < 0) throw std::logic_error("a ghost touches pressure nodes that its image does not");
    for (int a = 0; a < D; ++a) {
      to[a * stride_ + at] += sign[std::size_t(a)] * from[a * stride_ + j];
    }
  }
  empty_[std::size_t(place_[std::size_t(ghost)])] = 1;
}

template <int D>
void VolumeOperator<D>::note_unfolded(std::int64_t record) {
  const std::size_t place = std::size_t(place_[std::size_t(record)]);
  Unfolded node{record, empty_[place] != 0, {}, {}};
  if (!node.empty) {
    const double* q = q_.data() + place * std::size_t(D * stride_);
    node.q.assign(q, q + D * stride_);
  }
  for (std::size_t a = 0; a < D && !load_.empty(); ++a) {
    node.load[a] = load_[std::size_t(record) * D + a];
  }
  unfolded_.push_back(std::move(node));
}

/// The last fold first: a node may have been in several.
template <int D>
void VolumeOperator<D>::unfold() {
  for (auto node = unfolded_.rbegin(); node != unfolded_.rend(); ++node) {
    const std::size_t place = std::size_t(place_[std::size_t(node->record)]);
    empty_[place] = node->empty ? 1 : 0;
    std::copy(node->q.begin(), node->q.end(), q_.data() + place * std::size_t(D * stride_));
    for (std::size_t a = 0; a < D && !load_.empty(); ++a) {
      load_[std::size_t(node->record) * D + a] = node->load[a];
    }
  }
  unfolded_.clear();
}

template <int D>
std::int64_t VolumeOperator<D>::bytes() const {
  std::size_t kept = 0;
  for (const Unfolded& node : unfolded_) kept += sizeof(Unfolded) + 8 * node.q.capacity();
  return std::int64_t(kept + 8 * (q_.capacity() + load_.capacity() + pencils_.capacity()) +
                      sizeof(PressureNode<D>) * groups_.capacity() +
                      4 * (record_.capacity() + place_.capacity() + group_at_.capacity()) +
                      empty_.capacity());
}

template class VolumeOperator<2>;
template class VolumeOperator<3>;

}  // namespace scree
