// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/pressure_matrix.hpp"
#include "solver/exec/thread_pool.hpp"
#include "solver/grid/topology.hpp"
#include "solver/simulation/method.hpp"

namespace scree {

/// Inverse mass of a velocity node as the pressure sees it: one number an axis [1/kg], the same of
/// all axes but where a wall fixes one; negative in the first entry: the node is in other hands
/// (folded onto another, held by a collider) and is left out.
template <int D>
using InverseMass = std::array<double, D>;

/// The operator between pressures and velocities,
///
///     Q_ij = sum_p alpha_p V_p g_ip N_j(x_p),
///
/// g_ip the particle's gradient of node i, the same as in the force of the transfer (mls: w D^-1
/// (x_i - x_p), else grad w). The nodal force of a pressure is Q p; the rate of the pores' volume
/// in hat j is Q^T v over the number of lattices. One symbol for both makes momentum and volume
/// exact.
template <int D>
class VolumeOperator {
 public:
  VolumeOperator(const PressureLattice<D>& lattice, KernelType kernel, TransferType transfer,
                 double cell_size);

  /// Nodes an axis of the pressure lattice that a velocity node may touch.
  int width() const { return width_; }

  /// Must be called when the grid's blocks have changed.
  void rebuild(const Topology<D>& topology);

  void assemble(const FlowPoints<D>& points, const Topology<D>& topology, ThreadPool& pool);

  /// Forces on the nodes by the points' moments, f_i = sum_p moment_p g_ip, D entries a node; empty
  /// where no point is loaded. Folded like Q.
  const std::vector<double>& load() const { return load_; }

  /// Adds Q of node `ghost`, times a sign an axis, to that of `root`, whose velocity it follows,
  /// and zeroes its own.
  void fold(std::int64_t root, std::int64_t ghost, const std::array<std::int8_t, D>& sign,
            const PressureMatrix<D>& matrix);

  /// matrix += factor * sum over nodes of Q_i^T M_i^-1 Q_i, without the nodes in other hands.
  void add_schur(const std::vector<InverseMass<D>>& inverse, double factor,
                 PressureMatrix<D>& matrix, ThreadPool& pool) const;

  /// rhs -= factor * Q^T v; v: D entries a node.
  void subtract_rate(const std::vector<double>& velocity, double factor, PressureMatrix<D>& matrix,
                     ThreadPool& pool) const;

  /// force = Q p; D entries a node.
  void force(const PressureMatrix<D>& matrix, const std::vector<double>& pressure,
             std::vector<double>& force, ThreadPool& pool) const;

  /// Q_ij of node `record`: entry axis * width()^D + j; j counts the nodes from base(record), last
  /// axis fastest.
  const double* block(std::int64_t record) const {
    return q_.data() + std::size_t(record) * std::size_t(D * hats_);
  }
  const PressureNode<D>& base(std::int64_t record) const { return base_[std::size_t(record)]; }
  /// Rows of the pressure nodes of a velocity node, -1 where there is no water.
  void rows(std::int64_t record, const PressureMatrix<D>& matrix,
            std::vector<std::int32_t>& rows) const;
  int hats() const { return hats_; }

  std::int64_t bytes() const;

 private:
  /// Velocity nodes that touch the same pressure nodes.
  struct Group {
    PressureNode<D> base;
    std::int32_t begin, end;  ///< in members_
  };

  template <class F>
  void each_group(ThreadPool& pool, F&& f) const;
  template <class Kernel>
  void scatter(const FlowPoints<D>& points, const Topology<D>& topology, ThreadPool& pool);
  template <class Kernel, bool affine>
  void scatter_chunk(const FlowPoints<D>& points, const FlowChunk<D>& chunk,
                     const Topology<D>& topology);

  PressureLattice<D> lattice_;
  KernelType kernel_;
  TransferType transfer_;
  double cell_size_;
  int width_;
  int hats_;  ///< width_^D
  int lattices_;
  double reach_;  ///< half support of the kernel [cells]
  std::vector<PressureNode<D>> base_;
  std::vector<std::int32_t> members_;
  std::vector<Group> groups_;
  std::vector<std::vector<std::int32_t>> colours_;  ///< groups that share no pressure node
  std::vector<double> q_;
  std::vector<double> load_;
};

extern template class VolumeOperator<2>;
extern template class VolumeOperator<3>;

}  // namespace scree
