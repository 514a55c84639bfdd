// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/node_velocities.hpp"
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
///
/// Velocity nodes that touch the same pressure nodes form a group: spacing^D nodes of each lattice
/// with width()^D hats. A group's rows lie together, node by node and axis by axis, so the products
/// are dense and run through memory in order. Pressure cell and group fit each other: the points of
/// a cell touch the nodes of (width() - 1)^D whole groups, each with the 2^D hats of the cell.
template <int D>
class VolumeOperator {
 public:
  VolumeOperator(const PressureLattice<D>& lattice, KernelType kernel, TransferType transfer,
                 double cell_size);

  /// Nodes an axis of the pressure lattice that a velocity node may touch.
  int width() const { return width_; }

  /// Must be called when the grid's blocks have changed.
  void rebuild(const Topology<D>& topology);

  /// Q is nothing. loaded: points may have moments.
  void begin(bool loaded);
  /// Adds the points of a chunk, whose body has this alpha. Chunks of different columns of one
  /// colour (FlowColumns) may be added at the same time.
  void scatter(const FlowPoints<D>& points, const FlowChunk<D>& chunk, double biot);

  /// Forces on the nodes by the points' moments, f_i = sum_p moment_p g_ip, D entries a node; empty
  /// where no point is loaded. Folded like Q.
  const std::vector<double>& load() const { return load_; }

  /// Adds Q of node `ghost`, times a sign an axis, to that of `root`, whose velocity it follows,
  /// and zeroes its own.
  void fold(std::int64_t root, std::int64_t ghost, const std::array<std::int8_t, D>& sign);
  /// Notes what fold() changes from now on.
  void keep_unfolded(bool keep) { keeps_unfolded_ = keep; }
  /// Undoes all folds.
  void unfold();

  /// matrix += schur * sum over nodes of Q_i^T M_i^-1 Q_i, without the nodes in other hands.
  void add(const std::vector<InverseMass<D>>& inverse, double schur, PressureMatrix<D>& matrix,
           ThreadPool& pool) const;
  /// The matrix's right-hand side -= rate * Q^T v.
  void subtract_rates(const NodeVelocities& velocity, double rate, PressureMatrix<D>& matrix,
                      ThreadPool& pool) const;

  /// force = Q p; velocity += dt M^-1 Q p but for nodes in other hands; D entries a node.
  void push(const PressureMatrix<D>& matrix, const std::vector<double>& pressure,
            const std::vector<InverseMass<D>>& inverse, double dt, const NodeVelocities& velocity,
            std::vector<double>& force, ThreadPool& pool) const;

  /// Q_ij of node `record`: entry axis * stride() + j; j counts the nodes from base(record), last
  /// axis fastest, up to hats(). Null: nothing touches it.
  const double* block(std::int64_t record) const {
    const std::size_t place = std::size_t(place_[std::size_t(record)]);
    return empty_[place] != 0 ? nullptr : q_.data() + place * std::size_t(D * stride_);
  }
  const PressureNode<D>& base(std::int64_t record) const {
    return groups_[std::size_t(place_[std::size_t(record)] / slots_)];
  }
  /// Rows of the pressure nodes of a velocity node, -1 where there is no water.
  void rows(std::int64_t record, const PressureMatrix<D>& matrix,
            std::vector<std::int32_t>& rows) const;
  int hats() const { return hats_; }
  int stride() const { return stride_; }
  /// Hat j of a node, from its base.
  PressureNode<D> hat(int j) const;

  std::int64_t bytes() const;

 private:
  // volume_scatter.cpp
  template <class Kernel, int spacing>
  void scatter_chunk(const FlowPoints<D>& points, const FlowChunk<D>& chunk, double biot);
  template <class Kernel, int spacing, class Scratch>
  void flush(const PressureNode<D>& cell, Scratch& scratch);
  template <int reach>
  void fetch_group(const PressureNode<D>& cell, int g) const;

  // volume_products.cpp
  template <int N>
  void add_groups(const std::vector<InverseMass<D>>& inverse, double schur,
                  PressureMatrix<D>& matrix, ThreadPool& pool) const;
  template <int N>
  void subtract_group(std::size_t group, const NodeVelocities& velocity, double rate,
                      PressureMatrix<D>& matrix) const;
  template <int N>
  void push_group(std::size_t group, const double* pressure, const InverseMass<D>* inverse,
                  double dt, const NodeVelocities& velocity, double* force) const;
  void group_rows(std::size_t group, const PressureMatrix<D>& matrix, std::int32_t* rows) const;
  template <class F>
  void each_pencil(ThreadPool& pool, F&& f) const;

  std::int32_t lowest_node(int lattice) const;
  std::int32_t find_group(const PressureNode<D>& base) const;
  void number_groups(const std::vector<PressureNode<D>>& base);
  void find_pencils();
  /// A node before a fold.
  struct Unfolded {
    std::int64_t record;
    bool empty;
    std::vector<double> q;
    std::array<double, D> load;
  };

  double* touched(std::size_t place);
  void note_unfolded(std::int64_t record);
  int same_hat(std::int64_t root, std::int64_t ghost, int j) const;

  PressureLattice<D> lattice_;
  KernelType kernel_;
  TransferType transfer_;
  double cell_size_;
  int width_;
  int hats_;  ///< width_^D
  /// Numbers of a group's hats in the lattice from the first one on; none where axes are periodic.
  std::vector<std::int64_t> hat_steps_;
  int stride_;  ///< hats_, up to a multiple of four
  int lattices_;
  int slots_;                            ///< nodes of a group
  double reach_;                         ///< half support of the kernel [cells]
  std::vector<PressureNode<D>> groups_;  ///< lowest hats, in their order
  std::vector<std::int32_t> record_;     ///< by place = group * slots_ + slot; -1: not active
  std::vector<std::int32_t> place_;      ///< by record
  PressureNode<D> corner_{}, extent_{};  ///< of the box that holds all groups
  std::vector<std::int32_t> group_at_;   ///< in that box, -1: none
  /// Groups that differ in the last axis only, begin and end; sets that share no pressure node.
  std::vector<std::pair<std::int32_t, std::int32_t>> pencils_;
  std::vector<std::vector<std::int32_t>> colours_;
  AlignedVector<double> q_;   ///< by place
  std::vector<char> empty_;   ///< by place: nothing has been written to q_ in this step
  std::vector<double> load_;  ///< by record
  bool keeps_unfolded_ = false;
  std::vector<Unfolded> unfolded_;
};

extern template class VolumeOperator<2>;
extern template class VolumeOperator<3>;

}  // namespace scree
