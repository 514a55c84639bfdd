// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "materials/registry.hpp"
#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"
#include "solver/simulation/fault_text.hpp"
#include "solver/simulation/flow_increments.hpp"
#include "solver/simulation/simulation_impl.hpp"

namespace scree {

using Clock = std::chrono::steady_clock;

template <int D, class T>
void SimulationImpl<D, T>::step() {
  bin_if_needed();
  for (Collider& collider : colliders_) collider.set_step(clock_.time, clock_.dt);
  if (fused_) {
    step_fused();
  } else {
    step_split();
  }
  note_collider_work();
  for (Collider& collider : colliders_) collider.advance(clock_.dt);
  finish_step();
}

/// The grid holds the momenta of this step, scattered by the one before.
template <int D, class T>
void SimulationImpl<D, T>::step_fused() {
  if (stride_.begins()) collect_flow();
  // Within a stride they stay. (The second step's are once more, for the first step of all is
  // scattered by another pass and may differ by rounding.)
  if (stride_.steps() < 2) note_masses();
  update_grid();
  couple_flow(0);  // or it ends the run: such a step is not halved
  if (stride_.begins()) weigh_gained_water();
  const PlannedStep next = plan(clock_.next_time, step_ + 1);
  const auto start = Clock::now();
  recorded_ = setup_.record && setup_.schedule.record_due(clock_.next_time);
  if (strides()) backend_->set_stride(stride_step(next.dt));
  backend_->g2p2g(parameters(clock_.dt, next.dt));
  const PassReport<D> report = backend_->report();
  time_phase(Phase::particles, start);
  read_motion(report);
  read_signals(report);
  stride_.note(clock_.dt * report.max_speed / setup_.cell_size);
  planned_ = next;
}

/// Reference: the same step as separate passes over the particles.
template <int D, class T>
void SimulationImpl<D, T>::step_split() {
  update_external();
  collect_flow();
  for (int halvings = 0;; ++halvings) {
    scatter_all(clock_.dt);
    note_masses();
    update_grid();
    if (couple_flow(halvings)) break;
    halve_step();
  }
  planned_ = plan(clock_.next_time, step_ + 1);
  const Parameters pass = parameters(clock_.dt, clock_.dt);
  auto start = Clock::now();
  backend_->g2p(pass);
  const PassReport<D> motion = backend_->report();
  time_phase(Phase::particles, start);
  read_motion(motion);
  average_volumes(pass);
  start = Clock::now();
  backend_->stress(pass);
  const PassReport<D> signals = backend_->report();
  time_phase(Phase::stress, start);
  read_signals(signals);
  recorded_ = true;
}

/// Between the particles' motion and their laws (volumetric_locking).
template <int D, class T>
void SimulationImpl<D, T>::average_volumes(const Parameters& pass) {
  if (!averages()) return;
  const auto start = Clock::now();
  for (std::size_t b = 0; flow_ && b < bodies_.size(); ++b) {
    if (!flow_->has_water(std::int32_t(b))) continue;
    note_increments(bodies_[b].body->store(), layout_.increment, *flow_, executor_.pool());
  }
  backend_->average_volumes(pass);
  check_fault(backend_->report().fault);
  time_phase(Phase::particles, start);
}

/// Stress of the initial state, first step, first scatter.
template <int D, class T>
void SimulationImpl<D, T>::first_step() {
  backend_->stress(parameters(0, 0));
  read_signals(backend_->report());
  const PlannedStep first = plan_first();
  clock_ = {0, first.dt, first.end, 0};
  if (!fused_) return;
  scatter_all(clock_.dt);
  if (setup_.record) return;
  layout_ = make_layout(false);
  stride_fields_ = stride_fields(layout_);
  backend_->set_layout(layout_);
}

/// Particles to grid from the stored velocities and stresses, forces over a step dt.
template <int D, class T>
void SimulationImpl<D, T>::scatter_all(double dt) {
  const auto start = Clock::now();
  backend_->p2g(parameters(dt, dt));
  scattered_mass_ = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    scattered_mass_ += double(backend_->count(i)) * bodies_[i].body->info().particle_mass();
  }
  time_phase(Phase::particles, start);
}

/// Gravity in a step: that at its middle.
template <int D, class T>
std::array<double, 3> SimulationImpl<D, T>::gravity_of(double begin, double dt) const {
  return setup_.gravity ? setup_.gravity(begin + 0.5 * dt) : std::array<double, 3>{};
}

/// What acts on the nodes in this step.
template <int D, class T>
GridForces SimulationImpl<D, T>::grid_forces() const {
  GridForces forces;
  forces.dt = clock_.dt;
  forces.gravity = gravity_of(clock_.time, clock_.dt);
  forces.damping = setup_.damping;
  forces.damping_value = setup_.damping_value;
  forces.separate_force = separate_;
  return forces;
}

template <int D, class T>
void SimulationImpl<D, T>::update_grid() {
  const auto start = Clock::now();
  backend_->update_grid(grid_forces(), colliders_);
  time_phase(Phase::grid, start);
}

/// The two lattices' mean mass must be that of the particles: a scatter that lost some is a bug.
template <int D, class T>
void SimulationImpl<D, T>::check_mass(double grid_mass) const {
  const double tolerance = sizeof(T) == 8 ? 1e-9 : 1e-4;  // rounding of sums over nodes
  if (std::abs(grid_mass - scattered_mass_) <= tolerance * scattered_mass_) return;
  throw RunFault(mass_fault_text(step_ + 1, grid_mass, scattered_mass_));
}

template <int D, class T>
void SimulationImpl<D, T>::check_count() const {
  if (particle_count() + removed_ == initial_count_) return;
  throw RunFault(count_fault_text(step_ + 1, particle_count(), removed_, initial_count_));
}

template <int D, class T>
void SimulationImpl<D, T>::bin_if_needed() {
  if (!stride_.begins()) return;
  // A particle may speed up within the coming step: allow for twice its speed, the kick of gravity
  // and a share of the sound speed. Beyond a quarter cell binning cannot help; then it is a fault.
  double speed = 2 * bounds_.max_speed + 0.02 * bounds_.max_signal;
  if (setup_.gravity) {
    for (const double g : setup_.gravity(clock_.time)) speed += std::abs(g) * clock_.dt;
  }
  const double moved = stride_.most_drift() + clock_.dt * speed / setup_.cell_size;
  if (pending_dead_ == 0 && bounds_.max_excursion + std::min(moved, max_excursion) <= max_excursion)
    return;
  const auto start = Clock::now();
  std::array<std::int32_t, D> wrap{};
  for (int a = 0; a < D; ++a) {
    if (setup_.faces[a][0] == FaceType::periodic) wrap[a] = domain_.cells[a];
  }
  backend_->bin(wrap);
  order_flow();
  for (State& state : bodies_) state.dead = 0;
  pending_dead_ = 0;
  bounds_.max_excursion = 0;
  time_phase(Phase::binning, start);
}

template <int D, class T>
PassParameters<T> SimulationImpl<D, T>::pass_parameters(const State& state, double dt,
                                                        double dt_next) const {
  PassParameters<T> par;
  par.dt = T(dt);
  par.dt_next = T(dt_next);
  par.cell_size = T(setup_.cell_size);
  par.particle_mass = T(state.body->info().particle_mass());
  par.particle_volume = T(state.body->info().particle_volume);
  par.undrained_bulk_modulus = T(state.body->info().undrained_bulk_modulus);
  par.flip_blend = T(setup_.flip_blend);
  par.record = recorded_ && fused_ && layout_.velocity >= 0;
  par.separate_force = separate_;
  for (int a = 0; a < D; ++a) {
    const T far = T(1e30);
    const auto limit = [&](int side, bool open, T at, T outside) {
      return (setup_.faces[a][side] == FaceType::open) == open ? at : outside;
    };
    const T n = T(domain_.cells[a]);
    par.alive_lower[a] = limit(0, true, T(0), -far);
    par.alive_upper[a] = limit(1, true, n, far);
    par.closed_lower[a] = limit(0, false, T(-1), -far);
    par.closed_upper[a] = limit(1, false, n + T(1), far);
    const bool periodic = setup_.faces[a][0] == FaceType::periodic;
    par.wrap_lower[a] = periodic ? T(0) : -far;
    par.wrap_upper[a] = periodic ? n : far;
  }
  par.derive();
  return par;
}

/// The step within its stride; dt_next: of the step after it.
template <int D, class T>
StrideStep<T> SimulationImpl<D, T>::stride_step(double dt_next) const {
  StrideStep<T> step;
  step.fields = stride_fields_;
  step.begins = stride_.begins();
  step.ends = stride_.ends();
  step.steps = stride_.steps() + 1;
  const std::array<double, 3> gravity = gravity_of(clock_.next_time, dt_next);
  for (std::size_t a = 0; a < 3; ++a) step.gravity_next[a] = T(gravity[a]);
  return step;
}

/// The parameters of a pass, one a body.
template <int D, class T>
auto SimulationImpl<D, T>::parameters(double dt, double dt_next) const -> Parameters {
  Parameters all;
  for (const State& state : bodies_) all.push_back(pass_parameters(state, dt, dt_next));
  return all;
}

/// Speeds, strays and leavers of the pass that moved the particles, after the grid it read.
template <int D, class T>
void SimulationImpl<D, T>::read_motion(const PassReport<D>& report) {
  check_mass(report.grid_mass);
  check_fault(report.fault);
  bounds_.max_speed = report.max_speed;
  if (stride_.ends()) bounds_.max_excursion = report.max_excursion;
  if (report.fastest.body >= 0) fastest_ = report.fastest;
  pending_dead_ = 0;
  scattered_mass_ = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    State& state = bodies_[i];
    state.dead = report.dead[i];
    pending_dead_ += state.dead;
    scattered_mass_ += double(backend_->count(i) - state.dead) * state.body->info().particle_mass();
  }
  removed_ += pending_dead_;
}

/// Wave speeds of the pass that updated the materials.
template <int D, class T>
void SimulationImpl<D, T>::read_signals(const PassReport<D>& report) {
  check_fault(report.fault);
  bounds_.max_signal = report.max_signal;
  if (report.stiffest.body >= 0) stiffest_ = report.stiffest;
}

/// Stops the run at a fault.
template <int D, class T>
void SimulationImpl<D, T>::check_fault(const typename PassReport<D>::Fault& found) const {
  if (found.code == FaultCode::none) return;
  const BodyInfo& info = bodies_[std::size_t(found.body)].body->info();
  ParticleFault fault;
  fault.code = found.code;
  fault.step = step_ + 1;
  fault.id = found.id;
  fault.material = info.material;
  fault.value = found.value;
  if (const MaterialEntry* law = find_material_model(info.model)) {
    fault.inadmissible = law->inadmissible;
  }
  fault.fixed_step = setup_.step.has_value();
  fault.dimension = D;
  for (std::size_t a = 0; a < D; ++a) {
    const double cells = double(block_cells) * found.block[a] + found.position[a];
    fault.position[a] = setup_.lower[a] + setup_.cell_size * cells;
  }
  throw RunFault(fault_text(fault));
}

template <int D, class T>
void SimulationImpl<D, T>::finish_step() {
  clock_.last_dt = clock_.dt;
  clock_.time = clock_.next_time;
  clock_.dt = planned_.dt;
  clock_.next_time = planned_.end;
  ++step_;
  check_count();
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
