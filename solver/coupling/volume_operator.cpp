// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/volume_operator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scree {
namespace {

/// Hats of one group, each thread its own.
template <int D>
constexpr int most_hats = power(4, D);

/// local += factor * sum over axes of 1/m_a q_a q_a^T
template <int D, int hats>
void add_outer(const double* q, const InverseMass<D>& inverse, double factor, double* local) {
  for (int a = 0; a < D; ++a) {
    const double scale = factor * inverse[std::size_t(a)];
    if (scale == 0) continue;
    const double* row = q + a * hats;
    for (int j = 0; j < hats; ++j) {
      const double c = scale * row[j];
      double* out = local + j * hats;
      for (int l = 0; l < hats; ++l) out[l] += c * row[l];
    }
  }
}

template <int D>
PressureNode<D> hat_node(const PressureNode<D>& base, int width, int j) {
  PressureNode<D> node = base;
  for (int a = D - 1; a >= 0; --a) {
    node[a] += j % width;
    j /= width;
  }
  return node;
}

}  // namespace

template <int D>
VolumeOperator<D>::VolumeOperator(const PressureLattice<D>& lattice, KernelType kernel,
                                  TransferType transfer, double cell_size)
    : lattice_(lattice),
      kernel_(kernel),
      transfer_(transfer),
      cell_size_(cell_size),
      width_(lattice.spacing() == 1 ? 4 : 3),
      hats_(power(width_, D)),
      lattices_(kernel == KernelType::compact ? 2 : 1),
      reach_(kernel == KernelType::quadratic ? 1.5 : 1.0) {}

template <int D>
void VolumeOperator<D>::rebuild(const Topology<D>& topology) {
  constexpr int nodes = block_node_count<D>;
  const std::size_t records = std::size_t(topology.size()) * std::size_t(lattices_) * nodes;
  base_.resize(records);
  std::vector<std::pair<PressureNode<D>, std::int32_t>> order(records);
  for (std::size_t r = 0; r < records; ++r) {
    const BlockCoord<D> block = topology.coord(int(r / std::size_t(lattices_ * nodes)));
    const int lattice = int(r / nodes) % lattices_;
    int local = int(r % nodes);
    for (int a = D - 1; a >= 0; --a) {
      const double x = block_cells * block[a] + local % block_cells + 0.5 * lattice;
      base_[r][std::size_t(a)] = int(std::floor(lattice_.coordinate(x - reach_)));
      local /= block_cells;
    }
    order[r] = {base_[r], std::int32_t(r)};
  }
  std::sort(order.begin(), order.end());
  members_.clear();
  groups_.clear();
  colours_.assign(std::size_t(power(width_, D)), {});
  for (const auto& [base, record] : order) {
    if (groups_.empty() || groups_.back().base != base) {
      std::size_t colour = 0;
      for (int a = 0; a < D; ++a) {
        colour = colour * std::size_t(width_) +
                 std::size_t(((base[std::size_t(a)] % width_) + width_) % width_);
      }
      colours_[colour].push_back(std::int32_t(groups_.size()));
      groups_.push_back({base, std::int32_t(members_.size()), 0});
    }
    members_.push_back(record);
    groups_.back().end = std::int32_t(members_.size());
  }
}

template <int D>
template <class F>
void VolumeOperator<D>::each_group(ThreadPool& pool, F&& f) const {
  for (const auto& colour : colours_) {
    // Groups on both sides of a periodic face may share nodes whatever their colours.
    if (lattice_.periodic()) {
      for (const std::int32_t group : colour) f(groups_[std::size_t(group)]);
      continue;
    }
    pool.for_each(
        std::int64_t(colour.size()),
        [&](std::int64_t i, int) { f(groups_[std::size_t(colour[std::size_t(i)])]); }, 16);
  }
}

template <int D>
void VolumeOperator<D>::rows(std::int64_t record, const PressureMatrix<D>& matrix,
                             std::vector<std::int32_t>& rows) const {
  rows.resize(std::size_t(hats_));
  for (int j = 0; j < hats_; ++j)
    rows[std::size_t(j)] = matrix.row(hat_node<D>(base(record), width_, j));
}

template <int D>
void VolumeOperator<D>::fold(std::int64_t root, std::int64_t ghost,
                             const std::array<std::int8_t, D>& sign,
                             const PressureMatrix<D>& matrix) {
  for (std::size_t a = 0; a < D && !load_.empty(); ++a) {
    load_[std::size_t(root) * D + a] += sign[a] * load_[std::size_t(ghost) * D + a];
    load_[std::size_t(ghost) * D + a] = 0;
  }
  std::vector<std::int32_t> near, far;
  rows(root, matrix, near);
  rows(ghost, matrix, far);
  double* to = q_.data() + std::size_t(root) * std::size_t(D * hats_);
  double* from = q_.data() + std::size_t(ghost) * std::size_t(D * hats_);
  for (int j = 0; j < hats_; ++j) {
    bool any = false;
    for (int a = 0; a < D; ++a) any = any || from[a * hats_ + j] != 0;
    if (!any) continue;
    // What the ghost sees of the body lies within the root's reach too.
    const auto at = std::find(near.begin(), near.end(), far[std::size_t(j)]);
    if (at == near.end())
      throw std::logic_error("a ghost touches pressure nodes that its image does not");
    for (int a = 0; a < D; ++a) {
      to[a * hats_ + int(at - near.begin())] += sign[std::size_t(a)] * from[a * hats_ + j];
      from[a * hats_ + j] = 0;
    }
  }
}

template <int D>
void VolumeOperator<D>::add_schur(const std::vector<InverseMass<D>>& inverse, double factor,
                                  PressureMatrix<D>& matrix, ThreadPool& pool) const {
  std::vector<int> offsets(std::size_t(hats_ * hats_));
  for (int j = 0; j < hats_; ++j) {
    for (int l = 0; l < hats_; ++l) {
      offsets[std::size_t(j * hats_ + l)] =
          matrix.offset_index(hat_node<D>({}, width_, j), hat_node<D>({}, width_, l));
    }
  }
  each_group(pool, [&](const Group& group) {
    double local[most_hats<D> * most_hats<D>];
    bool any = false;
    for (std::int32_t i = group.begin; i < group.end; ++i) {
      const std::int32_t record = members_[std::size_t(i)];
      const InverseMass<D>& m = inverse[std::size_t(record)];
      bool acts = false;
      for (int a = 0; a < D; ++a) acts = acts || m[std::size_t(a)] > 0;
      if (!acts || m[0] < 0) continue;
      if (!any) std::fill(local, local + hats_ * hats_, 0.0);
      any = true;
      if (width_ == 3) {
        add_outer<D, power(3, D)>(block(record), m, factor, local);
      } else {
        add_outer<D, power(4, D)>(block(record), m, factor, local);
      }
    }
    if (!any) return;
    for (int j = 0; j < hats_; ++j) {
      const std::int32_t row = matrix.row(hat_node<D>(group.base, width_, j));
      if (row < 0) continue;
      for (int l = 0; l < hats_; ++l) {
        matrix.add(row, offsets[std::size_t(j * hats_ + l)], local[j * hats_ + l]);
      }
    }
  });
}

template <int D>
void VolumeOperator<D>::subtract_rate(const std::vector<double>& velocity, double factor,
                                      PressureMatrix<D>& matrix, ThreadPool& pool) const {
  each_group(pool, [&](const Group& group) {
    double local[most_hats<D>] = {};
    for (std::int32_t i = group.begin; i < group.end; ++i) {
      const std::int32_t record = members_[std::size_t(i)];
      const double* q = block(record);
      for (int a = 0; a < D; ++a) {
        const double v = velocity[std::size_t(record) * D + std::size_t(a)];
        if (v == 0) continue;
        for (int j = 0; j < hats_; ++j) local[j] += q[a * hats_ + j] * v;
      }
    }
    for (int j = 0; j < hats_; ++j) {
      const std::int32_t row = matrix.row(hat_node<D>(group.base, width_, j));
      if (row >= 0) matrix.rhs()[std::size_t(row)] -= factor * local[j];
    }
  });
}

template <int D>
void VolumeOperator<D>::force(const PressureMatrix<D>& matrix, const std::vector<double>& pressure,
                              std::vector<double>& force, ThreadPool& pool) const {
  force.resize(base_.size() * D);
  each_group(pool, [&](const Group& group) {
    double p[most_hats<D>] = {};
    for (int j = 0; j < hats_; ++j) {
      const std::int32_t row = matrix.row(hat_node<D>(group.base, width_, j));
      p[j] = row >= 0 ? pressure[std::size_t(row)] : 0.0;
    }
    for (std::int32_t i = group.begin; i < group.end; ++i) {
      const std::int32_t record = members_[std::size_t(i)];
      const double* q = block(record);
      for (int a = 0; a < D; ++a) {
        double sum = 0;
        for (int j = 0; j < hats_; ++j) sum += q[a * hats_ + j] * p[j];
        force[std::size_t(record) * D + std::size_t(a)] = sum;
      }
    }
  });
}

template <int D>
std::int64_t VolumeOperator<D>::bytes() const {
  return std::int64_t(8 * (q_.capacity() + load_.capacity()) +
                      sizeof(PressureNode<D>) * base_.capacity() +
                      sizeof(Group) * groups_.capacity() + 4 * members_.capacity());
}

template class VolumeOperator<2>;
template class VolumeOperator<3>;

}  // namespace scree
