// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/coupled_flow.hpp"

#include <algorithm>
#include <cmath>

#include "solver/coupling/flow_columns.hpp"

namespace scree {
namespace {

/// Of the pressure nodes' lattice [cells]. Every second velocity node where the kernel is one cell
/// wide, so that walls carry nodes and are mirror planes of the pressure too. Every cell, only
/// midpoints between the lattices keep the pressure free of checkerboards, which nodes of the
/// velocity do not see from where they are. Quadratic kernels reach too far for nodes on theirs.
double lattice_offset(KernelType kernel, int spacing) {
  if (kernel == KernelType::quadratic) return 0.5;
  return spacing == 1 ? 0.25 : 0.0;
}

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
      lattice_(setup_.pressure_spacing, lattice_offset(domain.kernel, setup_.pressure_spacing),
               domain.cells, domain.periodic, domain.walls),
      h_(setup_.pressure_spacing * domain.cell_size),
      lattices_(domain.kernel == KernelType::compact ? 2 : 1),
      volume_(lattice_, domain.kernel, domain.transfer, domain.cell_size),
      cells_(lattice_),
      matrix_(lattice_, volume_.width() - 1),
      product_(lattice_, volume_.width() - 1),
      surfaces_(std::move(setup_.drainage), first_ids(bodies_)),
      solver_(setup_.preconditioner.empty() ? default_preconditioner(D) : setup_.preconditioner,
              setup_.tolerance, setup_.solver_options),
      compressed_(solver_.needs_entries() || !PressureProduct<D>::serves(lattice_)),
      order_(lattice_),
      states_(particles),
      missed_(lattice_.size(), domain.stride),
      own_(domain.own_increments ? std::size_t(particles) : 0),
      outflow_(surfaces_.count(), 0.0) {
  setup_.drainage.clear();
  for (std::vector<double>& field : nodal_) field.assign(std::size_t(lattice_.size()), 0.0);
  for (const FlowBody& body : bodies_) {
    half_side_.push_back(0.5 * std::pow(body.particle_volume, 1.0 / D));
    biot_.push_back(body.pores ? body.pores->biot : 0.0);
  }
}

template <int D>
void CoupledFlow<D>::start(std::int64_t id, std::int32_t body, double pressure,
                           double volume_ratio) {
  const std::int64_t place = states_.place(id);
  states_.at(place, PoreRow<D>::pressure) = states_.at(place, PoreRow<D>::base) = pressure;
  states_.at(place, PoreRow<D>::ratio) = volume_ratio;
  states_.at(place, PoreRow<D>::start_ratio) = volume_ratio;
  start_mass_ += fluid_mass(body, id, volume_ratio);
}

template <int D>
void CoupledFlow<D>::end_order() {
  std::size_t body = 0;
  states_.end_order([&](std::int64_t id) {
    while (body + 1 < bodies_.size() && id >= bodies_[body + 1].first_id) ++body;
    left_ += fluid_mass(std::int32_t(body), id, number(id, PoreRow<D>::ratio));
  });
  point_of_.assign(std::size_t(states_.places()), -1);
  order_.forget();
}

template <int D>
void CoupledFlow<D>::follow(const Topology<D>& topology) {
  if (topology.keys() == blocks_) return;
  blocks_ = topology.keys();
  constraints_.forget();
  volume_.rebuild(topology);
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
void CoupledFlow<D>::time_part(Part part, Clock::time_point& start) {
  const Clock::time_point now = Clock::now();
  seconds_[std::size_t(part)] += std::chrono::duration<double>(now - start).count();
  start = now;
}

template <int D>
void CoupledFlow<D>::begin_points(bool loaded) {
  const std::int64_t count = chunks_.empty() ? 0 : chunks_.back().end;
  loaded_ = loaded;
  order_.resize(count);
  points_.resize(count);
}

template <int D>
void CoupledFlow<D>::assemble(const std::function<void(std::int32_t, FlowPoints<D>&)>& fill,
                              ThreadPool& pool) {
  auto start = Clock::now();
  order_.finish();
  for (auto* sums : {&storage_, &conductance_, &schur_}) sums->clear();
  folded_ = false;
  surfaces_.forget();
  cells_.begin(chunks_);
  volume_.begin(loaded_);
  // Bodies one after the other, columns of one colour at a time: each sum has one order.
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!bodies_[b].pores) continue;
    const bool all_alone = largest_half(b) > PoreCells<D>::longest_half;
    const FlowColumns<D> columns(chunks_, std::int32_t(b), domain_.cells, domain_.periodic,
                                 all_alone);
    for (const auto& of_colour : columns.colours) {
      pool.for_each(std::int64_t(of_colour.size()), [&](std::int64_t c, int) {
        for (const std::int32_t chunk : of_colour[std::size_t(c)]) assemble_chunk(chunk, fill);
      });
    }
    for (const auto& column : columns.alone) {
      for (const std::int32_t chunk : column) assemble_chunk(chunk, fill);
    }
  }
  time_part(Part::points, start);
}

/// Half side of the largest box of a body, in pressure cells.
template <int D>
double CoupledFlow<D>::largest_half(std::size_t body) const {
  return half_side_[body] / h_ * longest_box;
}

template <int D>
void CoupledFlow<D>::assemble_chunk(std::int32_t number,
                                    const std::function<void(std::int32_t, FlowPoints<D>&)>& fill) {
  const FlowChunk<D>& chunk = chunks_[std::size_t(number)];
  const std::size_t body = std::size_t(chunk.body);
  thread_local FlowPoints<D> points;
  points.resize(chunk.end - chunk.begin, loaded_);
  fill(number, points);
  keep(chunk, points);
  volume_.scatter(points, chunk, biot_[body]);
  cells_.add(points, chunk, {h_, largest_half(body)}, bodies_[body].pores->fluid_density);
}

template <int D>
bool CoupledFlow<D>::solve(const FlowStep<D>& step, const Topology<D>& topology, ThreadPool& pool) {
  auto start = Clock::now();
  prepare(step, topology);
  fold_volume(setup_.halvings > 0 || step.may_go_on);
  reactions_.assign(step.colliders->size(), Reaction{});
  if (!volume_.load().empty()) push_loads(step, topology, pool);
  time_part(Part::constraints, start);
  make_system(step, pool);
  time_part(Part::matrix, start);
  const bool solved = solve_system();
  time_part(Part::solve, start);
  if (!solved) {
    volume_.unfold();
    folded_ = false;
    return false;
  }
  volume_.push(matrix_, solution_, constraints_.inverse(), step.impulse(), velocity_, force_, pool);
  push_groups(step, force_, topology);
  time_part(Part::forces, start);
  return true;
}

/// The moments of loads change the velocities before the pressure does.
template <int D>
void CoupledFlow<D>::push_loads(const FlowStep<D>& step, const Topology<D>& topology,
                                ThreadPool& pool) {
  const auto& inverse = constraints_.inverse();
  const std::vector<double>& force = volume_.load();
  pool.for_each(
      std::int64_t(inverse.size()),
      [&](std::int64_t r, int) {
        const InverseMass<D>& m = inverse[std::size_t(r)];
        if (m[0] < 0) return;
        for (int a = 0; a < D; ++a) {
          const std::size_t i = std::size_t(r) * D + std::size_t(a);
          velocity_[r][a] += step.impulse() * m[std::size_t(a)] * force[i];
        }
      },
      256);
  push_groups(step, force, topology);
}

/// Forces on nodes in other hands change their velocities as far as walls and colliders let them.
template <int D>
void CoupledFlow<D>::push_groups(const FlowStep<D>& step, const std::vector<double>& force,
                                 const Topology<D>& topology) {
  for (const NodeGroup<D>& group : constraints_.groups()) {
    const Vec3<double> impulse = push_group(step, group, force);
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
                                        const std::vector<double>& forces) {
  double change[D] = {}, mass[D] = {};
  const double* force = &forces[std::size_t(group.root) * D];  // its ghosts' included
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) change[a] += step.impulse() * group.inverse[a][b] * force[b];
  }
  for (std::int32_t m = group.begin; m < group.end; ++m) {
    const auto& member = constraints_.members()[std::size_t(m)];
    for (int a = 0; a < D; ++a) {
      if (member.sign[std::size_t(a)] != 0) mass[a] += constraints_.mass(member.record);
      // Roots that no collider holds have their share already.
      if (m == group.begin && group.collider < 0) continue;
      velocity_[member.record][a] += member.sign[std::size_t(a)] * change[a];
    }
  }
  Vec3<double> impulse{};
  for (int a = 0; a < D; ++a) {
    impulse[a] = step.dt * force[a] - mass[a] / step.keep * change[a];
  }
  return impulse;
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
