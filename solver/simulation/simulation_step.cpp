// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "materials/registry.hpp"
#include "solver/base/error.hpp"
#include "solver/simulation/fault_text.hpp"
#include "solver/simulation/simulation_impl.hpp"
#include "solver/step/split_passes.hpp"

namespace scree {

using Clock = std::chrono::steady_clock;

namespace {

/// A maximum over blocks and where it is.
template <int D, class T>
void raise(double& most, double value, BlockPlace<D>& place, const BodyState<D, T>& state,
           std::size_t block) {
  if (!(value > most)) return;
  most = value;
  place.body = state.body->info().body_index;
  for (int a = 0; a < D; ++a) place.block[a] = state.coords[block * D + std::size_t(a)];
}

}  // namespace

template <int D, class T>
void SimulationImpl<D, T>::step() {
  bin_if_needed();
  for (Collider& collider : colliders_) collider.set_step(clock_.time, clock_.dt);
  if (fused_) {
    step_fused();
  } else {
    step_split();
  }
  for (Collider& collider : colliders_) collider.advance(clock_.dt);
  finish_step();
}

/// The grid holds the momenta of this step, scattered by the one before.
template <int D, class T>
void SimulationImpl<D, T>::step_fused() {
  update_grid();
  const PlannedStep next = plan(clock_.next_time, step_ + 1);
  const auto start = Clock::now();
  recorded_ = setup_.record && setup_.schedule.record_due(clock_.next_time);
  grid_.clear(next_, executor_.pool());
  for (State& state : bodies_) {
    PassData<D, T> data = pass_data(state, clock_.dt, next.dt);
    data.write[0] = next_.data();
    for (const auto& colour : state.colours) {
      state.body->g2p2g(executor_, data, colour, setup_.kernel);
    }
  }
  std::swap(current_, next_);
  time_phase(Phase::particles, start);
  read_motion();
  read_signals();
  planned_ = next;
}

/// Reference: the same step as separate passes over the particles.
template <int D, class T>
void SimulationImpl<D, T>::step_split() {
  update_external();
  scatter_all(clock_.dt);
  note_masses();
  update_grid();
  couple_flow();
  planned_ = plan(clock_.next_time, step_ + 1);
  auto start = Clock::now();
  for (State& state : bodies_) {
    const PassData<D, T> data = pass_data(state, clock_.dt, clock_.dt);
    run_g2p(setup_.kernel, setup_.transfer, executor_, data, state.all_blocks);
  }
  time_phase(Phase::particles, start);
  read_motion();
  start = Clock::now();
  for (State& state : bodies_) {
    state.body->stress(executor_, pass_data(state, clock_.dt, clock_.dt), state.all_blocks);
  }
  time_phase(Phase::stress, start);
  read_signals();
  recorded_ = true;
}

/// Stress of the initial state, first step, first scatter.
template <int D, class T>
void SimulationImpl<D, T>::first_step() {
  for (State& state : bodies_) {
    state.body->stress(executor_, pass_data(state, 0, 0), state.all_blocks);
  }
  read_signals();
  const PlannedStep first = plan_first();
  clock_ = {0, first.dt, first.end, 0};
  if (!fused_) return;
  scatter_all(clock_.dt);
  if (setup_.record) return;
  for (State& state : bodies_) state.body->store().resize_aux(0);
  layout_ = AuxLayout{};
}

/// Particles to grid from the stored velocities and stresses, forces over a step dt.
template <int D, class T>
void SimulationImpl<D, T>::scatter_all(double dt) {
  const auto start = Clock::now();
  grid_.clear(current_, executor_.pool());
  if (separate_) grid_.clear(extra_, executor_.pool());
  scattered_mass_ = 0;
  for (State& state : bodies_) {
    const PassData<D, T> data = pass_data(state, dt, dt);
    for (const auto& colour : state.colours) {
      run_p2g(setup_.kernel, setup_.transfer, executor_, data, colour);
    }
    scattered_mass_ += double(state.body->store().count()) * state.body->info().particle_mass();
  }
  time_phase(Phase::particles, start);
}

template <int D, class T>
void SimulationImpl<D, T>::update_grid() {
  const auto start = Clock::now();
  GridForces forces;
  forces.dt = clock_.dt;
  if (setup_.gravity) forces.gravity = setup_.gravity(clock_.time + 0.5 * clock_.dt);
  forces.damping = setup_.damping;
  forces.damping_value = setup_.damping_value;
  forces.separate_force = separate_;
  const double mass =
      grid_update_.apply(grid_, current_, extra_, forces, colliders_, executor_.pool());
  check_mass(mass);
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
  // A particle may speed up within the coming step: allow for twice its speed, the kick of gravity
  // and a share of the sound speed. Beyond a quarter cell binning cannot help; then it is a fault.
  double speed = 2 * bounds_.max_speed + 0.02 * bounds_.max_signal;
  if (setup_.gravity) {
    for (const double g : setup_.gravity(clock_.time)) speed += std::abs(g) * clock_.dt;
  }
  const double moved = clock_.dt * speed / setup_.cell_size;
  if (pending_dead_ == 0 && bounds_.max_excursion + std::min(moved, max_excursion) <= max_excursion)
    return;
  const auto start = Clock::now();
  std::array<std::int32_t, D> wrap{};
  for (int a = 0; a < D; ++a) {
    if (setup_.faces[a][0] == FaceType::periodic) wrap[a] = domain_.cells[a];
  }
  bool changed = false;
  for (State& state : bodies_) changed |= state.body->store().rebin(wrap);
  pending_dead_ = 0;
  bounds_.max_excursion = 0;
  if (changed) {
    const Topology<D> before = grid_.topology();
    // A particle that is moved to the other side takes along the blocks beyond the face.
    if (fused_) grid_update_.fold_periodic(current_);
    refresh_blocks();
    if (fused_) grid_.carry_over(before, current_);
  } else {
    for (State& state : bodies_) state.results.assign(state.results.size(), BlockResult<T>{});
  }
  time_phase(Phase::binning, start);
}

/// Rebuilds what hangs on the set of blocks.
template <int D, class T>
void SimulationImpl<D, T>::refresh_blocks() {
  std::vector<std::uint64_t> occupied;
  for (const State& state : bodies_) {
    for (const auto& block : state.body->store().blocks()) occupied.push_back(block.key);
  }
  std::sort(occupied.begin(), occupied.end());
  occupied.erase(std::unique(occupied.begin(), occupied.end()), occupied.end());
  grid_.topology().build(occupied, domain_);
  grid_update_.rebuild(grid_);
  if (flow_) flow_->rebuild(grid_.topology());
  for (State& state : bodies_) {
    const auto& blocks = state.body->store().blocks();
    state.grid_block.clear();
    state.coords.clear();
    state.all_blocks.clear();
    for (auto& colour : state.colours) colour.clear();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const BlockCoord<D> c = block_coord<D>(blocks[b].key);
      std::size_t colour = 0;
      for (int a = 0; a < D; ++a) {
        state.coords.push_back(c[a]);
        colour = 2 * colour + std::size_t(c[a] & 1);
      }
      state.grid_block.push_back(grid_.topology().find(blocks[b].key));
      state.colours[colour].push_back(std::int32_t(b));
      state.all_blocks.push_back(std::int32_t(b));
    }
    state.results.assign(blocks.size(), BlockResult<T>{});
  }
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
  par.record = recorded_ && fused_ && layout_.total > 0;
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
  return par;
}

template <int D, class T>
PassData<D, T> SimulationImpl<D, T>::pass_data(State& state, double dt, double dt_next) {
  ParticleStore<D, T>& store = state.body->store();
  PassData<D, T> data;
  data.parameters = pass_parameters(state, dt, dt_next);
  data.layout = layout_;
  data.fields = store.fields();
  data.particles = store.count() > 0 ? store.batch(0) : nullptr;
  data.aux = store.count() > 0 ? store.aux_batch(0) : nullptr;
  data.ids = store.count() > 0 ? store.ids(0) : nullptr;
  data.batch_begin = store.batch_begin().data();
  data.batch_list = store.batch_list().data();
  data.counts = store.counts().data();
  data.grid_block = state.grid_block.data();
  data.coords = state.coords.data();
  data.neighbours = grid_.topology().neighbour_table().data();
  data.read[0] = current_.data();
  data.read[1] = extra_.data();
  data.write[0] = current_.data();
  data.write[1] = extra_.data();
  data.results = state.results.data();
  return data;
}

/// Stops at the first fault, in the order of bodies and blocks, so that it is always the same one.
template <int D, class T>
void SimulationImpl<D, T>::check_faults() const {
  for (const State& state : bodies_) {
    for (std::size_t b = 0; b < state.results.size(); ++b) {
      if (state.results[b].fault != FaultCode::none) fail(state, b);
    }
  }
}

/// Speeds, strays and leavers of the pass that moved the particles.
template <int D, class T>
void SimulationImpl<D, T>::read_motion() {
  check_faults();
  bounds_.max_speed = bounds_.max_excursion = 0;
  pending_dead_ = 0;
  scattered_mass_ = 0;
  for (const State& state : bodies_) {
    std::int64_t dead = 0;
    for (std::size_t b = 0; b < state.results.size(); ++b) {
      const BlockResult<T>& result = state.results[b];
      raise(bounds_.max_speed, double(result.max_speed), fastest_, state, b);
      bounds_.max_excursion = std::max(bounds_.max_excursion, double(result.max_excursion));
      dead += result.dead;
    }
    pending_dead_ += dead;
    scattered_mass_ +=
        double(state.body->store().count() - dead) * state.body->info().particle_mass();
  }
  removed_ += pending_dead_;
}

/// Wave speeds of the pass that updated the materials.
template <int D, class T>
void SimulationImpl<D, T>::read_signals() {
  check_faults();
  bounds_.max_signal = 0;
  for (const State& state : bodies_) {
    for (std::size_t b = 0; b < state.results.size(); ++b) {
      raise(bounds_.max_signal, double(state.results[b].max_signal), stiffest_, state, b);
    }
  }
}

template <int D, class T>
void SimulationImpl<D, T>::fail(const State& state, std::size_t block) const {
  const BlockResult<T>& result = state.results[block];
  ParticleFault fault;
  fault.code = result.fault;
  fault.step = step_ + 1;
  fault.id = result.fault_id;
  fault.material = state.body->info().material;
  fault.value = double(result.fault_value);
  if (const MaterialEntry* law = find_material_model(state.body->info().model)) {
    fault.inadmissible = law->inadmissible;
  }
  fault.fixed_step = setup_.step.has_value();
  fault.dimension = D;
  for (int a = 0; a < D; ++a) {
    const double cells = double(block_cells) * state.coords[block * D + std::size_t(a)] +
                         double(result.fault_position[a]);
    fault.position[std::size_t(a)] = setup_.lower[std::size_t(a)] + setup_.cell_size * cells;
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
