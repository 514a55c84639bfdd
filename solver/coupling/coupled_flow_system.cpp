// SPDX-License-Identifier: Apache-2.0
// The system of the pressures of a step.
#include <algorithm>

#include "solver/coupling/coupled_flow.hpp"

namespace scree {

/// Which nodes move, and which have a pressure.
template <int D>
void CoupledFlow<D>::prepare(const FlowStep<D>& step, const Topology<D>& topology) {
  constraints_.find(
      step.decisions, velocity_, *step.colliders,
      [&](std::int64_t record) { return position(record, topology); }, step.touch);
  if (!matrix_.set_nodes(cells_.marks(), compressed_) || matrix_.rows() == 0) return;
  if (compressed_) {
    solver_.set_pattern(matrix_.row_begin(), matrix_.columns());
  } else {
    product_.set_nodes(matrix_);
    solver_.set_action(product_);
  }
}

/// Folds Q as the constraints have it. again: it may have to be folded otherwise for the same
/// points.
template <int D>
void CoupledFlow<D>::fold_volume(bool again) {
  if (folded_ && constraints_.unchanged()) return;
  volume_.unfold();
  volume_.keep_unfolded(again);
  for (const NodeGroup<D>& group : constraints_.groups()) {
    for (std::int32_t m = group.begin + 1; m < group.end; ++m) {
      const auto& ghost = constraints_.members()[std::size_t(m)];
      volume_.fold(group.root, ghost.record, ghost.sign);
    }
  }
  folded_ = true;
}

template <int D>
void CoupledFlow<D>::make_system(const FlowStep<D>& step, ThreadPool& pool) {
  if (step.may_go_on) {
    sum_matrix(step, pool);
  } else {
    sum_once(step, pool);
  }
  // Within a stride the points' pressures are those of the nodes.
  cells_.add_sources(step.dt, step.gravity, step.begins ? nullptr : nodal_[0].data(), matrix_);
  subtract_missed(step);
  surfaces_.place([this](std::int64_t id) { return surface_point(id); },
                  [this](std::int64_t id) { return deformation(id); }, h_, domain_.cell_size,
                  lattice_, domain_.lower);
  surfaces_.add(step.end, matrix_);
  volume_.subtract_rates(velocity_, 1.0 / lattices_, matrix_, pool);
  finish_matrix(pool);
}

/// S/dt + H + dt/L sum Q^T M^-1 Q for this step alone.
template <int D>
void CoupledFlow<D>::sum_once(const FlowStep<D>& step, ThreadPool& pool) {
  matrix_.clear();
  volume_.add(constraints_.inverse(), step.impulse() / lattices_, matrix_, pool);
  add_held(step.impulse() / lattices_);
  cells_.add_storage(1 / step.dt, matrix_);
  cells_.add_flow(matrix_);
}

/// The right-hand side less what tr(dt grad v) misses.
template <int D>
void CoupledFlow<D>::subtract_missed(const FlowStep<D>& step) {
  if (step.begins) missed_.begin(cells_.missed());
  for (std::size_t r = 0; r < matrix_.nodes().size(); ++r) {
    matrix_.rhs()[r] -= missed_.rate(matrix_.nodes()[r], step.dt);
  }
}

/// S/dt + H + dt/L sum Q^T M^-1 Q from its parts. The three stay while the points do, the last one
/// while the constraints do too.
template <int D>
void CoupledFlow<D>::sum_matrix(const FlowStep<D>& step, ThreadPool& pool) {
  if (storage_.empty()) {
    sum_up(storage_, [&] { cells_.add_storage(1, matrix_); });
    sum_up(conductance_, [&] { cells_.add_flow(matrix_); });
  }
  if (schur_.empty() || !constraints_.unchanged()) {
    sum_up(schur_, [&] {
      volume_.add(constraints_.inverse(), 1.0 / lattices_, matrix_, pool);
      add_held(1.0 / lattices_);
    });
  }
  const double per_dt = 1 / step.dt, impulse = step.impulse();
  double* sums = matrix_.stencils().data();
  const double *s = storage_.data(), *h = conductance_.data(), *q = schur_.data();
  for (std::size_t i = 0; i < schur_.size(); ++i) sums[i] = per_dt * s[i] + h[i] + impulse * q[i];
}

/// sums = what add() adds to the matrix.
template <int D>
template <class Add>
void CoupledFlow<D>::sum_up(AlignedVector<double>& sums, Add&& add) {
  matrix_.clear();
  add();
  sums = matrix_.stencils();
}

/// Nodes that colliders hold, whose inverse mass is a matrix.
template <int D>
void CoupledFlow<D>::add_held(double factor) {
  std::vector<std::int32_t> rows;
  const int hats = volume_.hats(), stride = volume_.stride();
  for (const NodeGroup<D>& group : constraints_.groups()) {
    const double* q = group.collider < 0 ? nullptr : volume_.block(group.root);
    if (q == nullptr) continue;
    volume_.rows(group.root, matrix_, rows);
    for (int j = 0; j < hats; ++j) {
      double moved[D];
      bool any = false;
      for (int a = 0; a < D; ++a) {
        moved[a] = 0;
        for (int b = 0; b < D; ++b) moved[a] += factor * group.inverse[a][b] * q[b * stride + j];
        any = any || moved[a] != 0;
      }
      if (!any || rows[std::size_t(j)] < 0) continue;
      for (int l = j; l < hats; ++l) {
        double value = 0;
        for (int a = 0; a < D; ++a) value += moved[a] * q[a * stride + l];
        const int offset = matrix_.offset_index(volume_.hat(j), volume_.hat(l));
        if (value != 0) matrix_.add(rows[std::size_t(j)], offset, value);
      }
    }
  }
}

/// The matrix in the form that the solver takes.
template <int D>
void CoupledFlow<D>::finish_matrix(ThreadPool& pool) {
  if (compressed_) {
    matrix_.finish();
  } else {
    product_.set_values(matrix_, pool);
  }
}

template <int D>
bool CoupledFlow<D>::solve_system() {
  solution_.resize(std::size_t(matrix_.rows()));
  iterations_ = 0;
  if (matrix_.rows() == 0) return true;
  for (std::size_t r = 0; r < solution_.size(); ++r) {
    // As if the pressure went on as in the last steps; nodes that had none begin with zero.
    const std::size_t node = std::size_t(matrix_.nodes()[r]);
    const double last = nodal_[0][node], before = nodal_[1][node], first = nodal_[2][node];
    solution_[r] = before == 0 ? last : 2 * last - before;
    if (before != 0 && first != 0) solution_[r] += last - 2 * before + first;
  }
  const auto solve = [&] {
    report_ = compressed_ ? solver_.solve(matrix_.values(), matrix_.rhs(), solution_)
                          : solver_.solve(matrix_.rhs(), solution_);
    return report_.converged;
  };
  // Where pressures turn sign all at once what the last ones lead to may be far worse than nothing.
  if (!solve()) {
    std::fill(solution_.begin(), solution_.end(), 0.0);
    (void)solve();
  }
  if (!report_.converged) return false;
  iterations_ = report_.iterations;
  for (std::size_t r = 0; r < solution_.size(); ++r) {
    const std::size_t node = std::size_t(matrix_.nodes()[r]);
    nodal_[2][node] = nodal_[1][node];
    nodal_[1][node] = nodal_[0][node];
    nodal_[0][node] = solution_[r];
  }
  return true;
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
