// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/coupled_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/error.hpp"

namespace scree {
namespace {

/// Of the pressure nodes' lattice: midpoints between the velocity nodes.
double lattice_offset(KernelType kernel) { return kernel == KernelType::compact ? 0.25 : 0.5; }

/// icc needs few iterations, but to set it up takes longer than they do in 3D, where rows are long.
std::string preconditioner(const CouplingSetup& setup, int dimension) {
  if (!setup.preconditioner.empty()) return setup.preconditioner;
  return dimension == 2 ? "icc" : "jacobi";
}

/// Stretch at which a particle's box stops to grow: far beyond, in long flows, F says no more which
/// part of the soil is the particle's.
constexpr double longest_box = 2;

std::vector<std::int64_t> first_ids(const std::vector<FlowBody>& bodies) {
  std::vector<std::int64_t> ids;
  for (const FlowBody& body : bodies) ids.push_back(body.first_id);
  return ids;
}

}  // namespace

template <int D>
CoupledFlow<D>::CoupledFlow(CouplingSetup setup, const FlowDomain<D>& domain,
                            std::vector<FlowBody> bodies, std::int64_t particles)
    : setup_(std::move(setup)),
      domain_(domain),
      bodies_(std::move(bodies)),
      lattice_(setup_.pressure_spacing, lattice_offset(domain.kernel), domain.cells,
               domain.periodic),
      h_(setup_.pressure_spacing * domain.cell_size),
      lattices_(domain.kernel == KernelType::compact ? 2 : 1),
      volume_(lattice_, domain.kernel, domain.transfer, domain.cell_size),
      cells_(lattice_),
      matrix_(lattice_, volume_.width() - 1),
      surfaces_(std::move(setup_.drainage), first_ids(bodies_)),
      solver_(preconditioner(setup_, D), setup_.tolerance, setup_.solver_options),
      point_of_(std::size_t(particles), -1),
      nodal_(std::size_t(lattice_.size()), 0.0),
      pressure_(std::size_t(particles), 0.0),
      ratio_(std::size_t(particles), 1.0),
      start_ratio_(std::size_t(particles), 1.0),
      stored_(std::size_t(particles), 0.0),
      seepage_(std::size_t(particles) * D, 0.0),
      deformation_(std::size_t(particles) * D * D, 0.0),
      outflow_(surfaces_.count(), 0.0) {
  setup_.drainage.clear();
  for (std::size_t i = 0; i < deformation_.size(); i += D * D) {
    for (std::size_t a = 0; a < D; ++a) deformation_[i + a * (D + 1)] = 1;
  }
}

template <int D>
void CoupledFlow<D>::start(std::int64_t id, std::int32_t body, double pressure,
                           double volume_ratio) {
  pressure_[std::size_t(id)] = pressure;
  ratio_[std::size_t(id)] = start_ratio_[std::size_t(id)] = volume_ratio;
  start_mass_ += fluid_mass(body, id, volume_ratio);
}

template <int D>
void CoupledFlow<D>::follow(const Topology<D>& topology) {
  if (topology.keys() == blocks_) return;
  blocks_ = topology.keys();
  volume_.rebuild(topology);
}

template <int D>
Mat3<double> CoupledFlow<D>::deformation(std::int64_t id) const {
  Mat3<double> f = identity3<double>();
  for (int i = 0; i < D * D; ++i) {
    f(i / D, i % D) = deformation_[std::size_t(id) * D * D + std::size_t(i)];
  }
  return f;
}

template <int D>
void CoupledFlow<D>::fill(FlowPoint<D>& point, std::int32_t body, const double (&u)[D],
                          const Mat3<double>& increment) {
  const std::size_t id = std::size_t(point.id);
  const FlowBody& flow = bodies_[std::size_t(body)];
  const PoreSetup& pores = *flow.pores;
  Mat3<double> f = identity3<double>() + increment;
  const double before = ratio_[id];
  ratio_[id] = before * det(f);
  const double linear = before * (1 + increment(0, 0) + increment(1, 1) + increment(2, 2));
  for (int a = 0; a < D; ++a) {
    const double y = lattice_.coordinate(u[a]);
    point.cell[std::size_t(a)] = int(std::floor(y));
    point.xi[a] = y - std::floor(y);
  }
  const Mat3<double> total = f * deformation(point.id);
  const double side = 2 * half_side(body);
  for (int a = 0; a < D; ++a) {
    double square = 0;
    for (int b = 0; b < D; ++b) {
      square += total(a, b) * total(a, b);
      deformation_[id * D * D + std::size_t(a * D + b)] = total(a, b);
    }
    point.half[a] = 0.5 * side / h_ * std::min(std::sqrt(square), longest_box);
  }
  const double porosity = porosity_at(pores, ratio_[id] / start_ratio_[id]);
  point.volume = flow.particle_volume * ratio_[id];
  point.storage = storage_at(pores, porosity);
  point.mobility = mobility_at(pores, porosity);
  point.biot = pores.biot;
  point.fluid_density = pores.fluid_density;
  point.pressure = pressure_[id];
  point.defect = flow.particle_volume * (ratio_[id] - linear);
}

/// Water of particles that have gone since the last step counts as outflow.
template <int D>
void CoupledFlow<D>::index_points() {
  std::vector<std::int32_t> now(point_of_.size(), -1);
  for (const FlowChunk<D>& chunk : points_.chunks) {
    for (std::int64_t i = chunk.begin; i < chunk.end; ++i) {
      now[std::size_t(points_.points[std::size_t(i)].id)] = std::int32_t(i);
    }
  }
  std::size_t body = 0;
  for (std::size_t id = 0; id < now.size(); ++id) {
    while (body + 1 < bodies_.size() && std::int64_t(id) >= bodies_[body + 1].first_id) ++body;
    if (point_of_[id] < 0 || now[id] >= 0) continue;
    left_ += fluid_mass(std::int32_t(body), std::int64_t(id), ratio_[id]);
  }
  point_of_ = std::move(now);
}

template <int D>
std::array<double, 3> CoupledFlow<D>::position(std::int64_t record,
                                               const Topology<D>& topology) const {
  constexpr int nodes = block_node_count<D>;
  const BlockCoord<D> block = topology.coord(int(record / (lattices_ * nodes)));
  const int lattice = int(record / nodes) % lattices_;
  int local = int(record % nodes);
  std::array<double, 3> x = domain_.lower;
  for (int a = D - 1; a >= 0; --a) {
    x[std::size_t(a)] += domain_.cell_size * (block_cells * block[std::size_t(a)] +
                                              local % block_cells + 0.5 * lattice);
    local /= block_cells;
  }
  return x;
}

template <int D>
void CoupledFlow<D>::solve(const FlowStep<D>& step, std::vector<double>& velocity,
                           const Topology<D>& topology, ThreadPool& pool) {
  index_points();
  constraints_.find(
      step.decisions, velocity, *step.colliders,
      [&](std::int64_t record) { return position(record, topology); }, step.touch);
  if (matrix_.set_nodes(cells_.find_cells(points_))) {
    if (matrix_.rows() > 0) solver_.set_pattern(matrix_.row_begin(), matrix_.columns());
  }
  volume_.assemble(points_, topology, pool);
  for (const NodeGroup<D>& group : constraints_.groups()) {
    for (std::int32_t m = group.begin + 1; m < group.end; ++m) {
      const auto& ghost = constraints_.members()[std::size_t(m)];
      volume_.fold(group.root, ghost.record, ghost.sign, matrix_);
    }
  }
  reactions_.assign(step.colliders->size(), Reaction{});
  if (!volume_.load().empty()) push(step, volume_.load(), velocity, topology, pool);
  assemble(step, velocity, pool);
  solve_system(step);
  volume_.force(matrix_, solution_, force_, pool);
  push(step, force_, velocity, topology, pool);
  gather(step.dt, step.gravity, pool);
}

template <int D>
void CoupledFlow<D>::assemble(const FlowStep<D>& step, const std::vector<double>& velocity,
                              ThreadPool& pool) {
  cells_.assemble(points_, step.dt, step.gravity, h_);
  cells_.add(matrix_);
  surfaces_.add(
      points_, point_of_, [this](std::int64_t id) { return deformation(id); }, step.end, h_,
      domain_.cell_size, lattice_, domain_.lower, matrix_);
  volume_.add_schur(constraints_.inverse(), step.dt / lattices_, matrix_, pool);
  add_held(step.dt / lattices_);
  volume_.subtract_rate(velocity, 1.0 / lattices_, matrix_, pool);
}

/// Nodes that colliders hold, whose inverse mass is a matrix.
template <int D>
void CoupledFlow<D>::add_held(double factor) {
  std::vector<std::int32_t> rows;
  const int hats = volume_.hats();
  for (const NodeGroup<D>& group : constraints_.groups()) {
    if (group.collider < 0) continue;
    volume_.rows(group.root, matrix_, rows);
    const double* q = volume_.block(group.root);
    for (int j = 0; j < hats; ++j) {
      double moved[D];
      bool any = false;
      for (int a = 0; a < D; ++a) {
        moved[a] = 0;
        for (int b = 0; b < D; ++b) moved[a] += factor * group.inverse[a][b] * q[b * hats + j];
        any = any || moved[a] != 0;
      }
      if (!any) continue;
      for (int l = 0; l < hats; ++l) {
        double value = 0;
        for (int a = 0; a < D; ++a) value += moved[a] * q[a * hats + l];
        if (value != 0) matrix_.add_pair(rows[std::size_t(j)], rows[std::size_t(l)], value);
      }
    }
  }
}

template <int D>
void CoupledFlow<D>::solve_system(const FlowStep<D>& step) {
  solution_.resize(std::size_t(matrix_.rows()));
  iterations_ = 0;
  if (matrix_.rows() == 0) return;
  for (std::size_t r = 0; r < solution_.size(); ++r) {
    solution_[r] = nodal_[std::size_t(matrix_.nodes()[r])];
  }
  const SolveReport report = solver_.solve(matrix_.values(), matrix_.rhs(), solution_);
  iterations_ = report.iterations;
  if (!report.converged) {
    throw RunFault(fmt::format(
        "pore pressure at t = {:.6g} s: the solver stopped after {} iterations with a relative "
        "residual of {:.3g} ({}); try coupling.preconditioner = \"icc\" or \"gamg\", a larger "
        "coupling.tolerance, or a shorter time step",
        step.end, report.iterations, report.residual, report.reason));
  }
  for (std::size_t r = 0; r < solution_.size(); ++r) {
    nodal_[std::size_t(matrix_.nodes()[r])] = solution_[r];
  }
}

/// Forces on the nodes change the velocities as far as walls and colliders let them.
template <int D>
void CoupledFlow<D>::push(const FlowStep<D>& step, const std::vector<double>& force,
                          std::vector<double>& velocity, const Topology<D>& topology,
                          ThreadPool& pool) {
  const auto& inverse = constraints_.inverse();
  pool.for_each(
      std::int64_t(inverse.size()),
      [&](std::int64_t r, int) {
        const InverseMass<D>& m = inverse[std::size_t(r)];
        if (m[0] < 0) return;
        for (int a = 0; a < D; ++a) {
          const std::size_t i = std::size_t(r) * D + std::size_t(a);
          velocity[i] += step.dt * m[std::size_t(a)] * force[i];
        }
      },
      256);
  for (const NodeGroup<D>& group : constraints_.groups()) {
    const Vec3<double> impulse = push_group(step, group, force, velocity);
    if (group.collider < 0) continue;
    Vec3<double> arm{};
    const Collider& collider = (*step.colliders)[std::size_t(group.collider)];
    const Vec3<double> centre = collider.reference_point();
    const Vec3<double> place = collider.unwrapped(position(group.root, topology).data());
    for (int a = 0; a < 3; ++a) arm[a] = place[a] - centre[a];
    const Vec3<double> torque = cross(arm, impulse);
    Reaction& reaction = reactions_[std::size_t(group.collider)];
    for (int a = 0; a < 3; ++a) {
      reaction.force[std::size_t(a)] += impulse[a] / (lattices_ * step.dt);
      reaction.torque[std::size_t(a)] += torque[a] / (lattices_ * step.dt);
    }
  }
}

/// Returns the impulse that the force gives to what holds the group.
template <int D>
Vec3<double> CoupledFlow<D>::push_group(const FlowStep<D>& step, const NodeGroup<D>& group,
                                        const std::vector<double>& forces,
                                        std::vector<double>& velocity) {
  double change[D] = {}, mass[D] = {};
  const double* force = &forces[std::size_t(group.root) * D];  // its ghosts' included
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) change[a] += step.dt * group.inverse[a][b] * force[b];
  }
  for (std::int32_t m = group.begin; m < group.end; ++m) {
    const auto& member = constraints_.members()[std::size_t(m)];
    for (int a = 0; a < D; ++a) {
      if (member.sign[std::size_t(a)] != 0) mass[a] += constraints_.mass(member.record);
      // Roots that no collider holds have their share already.
      if (m == group.begin && group.collider < 0) continue;
      velocity[std::size_t(member.record) * D + std::size_t(a)] +=
          member.sign[std::size_t(a)] * change[a];
    }
  }
  Vec3<double> impulse{};
  for (int a = 0; a < D; ++a) {
    impulse[a] = step.dt * force[a] - mass[a] / step.decisions.keep * change[a];
  }
  return impulse;
}

/// Pressure and seepage of the particles.
template <int D>
void CoupledFlow<D>::gather(double dt, const std::array<double, 3>& gravity, ThreadPool& pool) {
  constexpr int corners = 1 << D;
  pool.for_each(std::int64_t(points_.chunks.size()), [&](std::int64_t c, int) {
    const FlowChunk<D>& chunk = points_.chunks[std::size_t(c)];
    for (std::int64_t i = chunk.begin; i < chunk.end; ++i) {
      const FlowPoint<D>& p = points_.points[std::size_t(i)];
      double n[corners], slope[corners][D], value = 0, gradient[D] = {};
      hats<D>(p.xi, n);
      hat_slopes<D>(p.xi, slope);
      for (int k = 0; k < corners; ++k) {
        const double nodal = solution_[std::size_t(matrix_.row(corner<D>(p.cell, k)))];
        value += n[k] * nodal;
        for (int a = 0; a < D; ++a) gradient[a] += slope[k][a] * nodal / h_;
      }
      const std::size_t id = std::size_t(p.id);
      stored_[id] += p.volume * p.storage * (value - pressure_[id]);
      pressure_[id] = value;
      for (int a = 0; a < D; ++a) {
        seepage_[id * D + std::size_t(a)] =
            -p.mobility * (gradient[a] - p.fluid_density * gravity[std::size_t(a)]);
      }
    }
  });
  surfaces_.add_outflow(matrix_, solution_, dt, outflow_);
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
