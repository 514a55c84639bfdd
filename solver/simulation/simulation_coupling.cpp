// SPDX-License-Identifier: Apache-2.0
// Pore water in the step: what CoupledFlow needs of particles and grid, and back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"
#include "solver/coupling/point_order.hpp"
#include "solver/simulation/simulation_impl.hpp"

namespace scree {

template <int D, class T>
void SimulationImpl<D, T>::make_flow() {
  if (!setup_.coupling) return;
  if (backend_->updated_grid().velocities == nullptr) {
    throw UserError("coupling is computed by the processor; use the backend cpu");
  }
  FlowDomain<D> domain;
  domain.kernel = setup_.kernel;
  domain.transfer = setup_.transfer;
  domain.lower = setup_.lower;
  domain.cell_size = setup_.cell_size;
  domain.own_increments = averages();
  if (fused_) domain.stride = setup_.coupling->stride;
  for (int a = 0; a < D; ++a) {
    domain.cells[std::size_t(a)] = domain_.cells[a];
    domain.periodic[std::size_t(a)] = setup_.faces[std::size_t(a)][0] == FaceType::periodic;
    for (std::size_t side = 0; side < 2; ++side) {
      const FaceType type = setup_.faces[std::size_t(a)][side];
      domain.walls[std::size_t(a)][side] = type != FaceType::open && type != FaceType::periodic;
    }
  }
  std::vector<FlowBody> bodies;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    bodies.push_back(
        {setup_.bodies[b].pores, setup_.bodies[b].particle_volume, bodies_[b].first_id});
  }
  if (fused_) stride_ = Stride(setup_.coupling->stride, setup_.coupling->stride_drift);
  flow_ = std::make_unique<CoupledFlow<D>>(std::move(*setup_.coupling), domain, std::move(bodies),
                                           particle_count());
  setup_.coupling.emplace();  // still says that there is coupling
  order_flow();
  start_flow();
}

/// Tells the water where the stores have the particles.
template <int D, class T>
void SimulationImpl<D, T>::order_flow() {
  if (!flow_) return;
  constexpr int width = ParticleStore<D, T>::width;
  PoreStates<D>& states = flow_->states();
  std::vector<std::int64_t> slots;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const ParticleStore<D, T>& store = bodies_[b].body->store();
    slots.push_back(flow_->has_water(std::int32_t(b)) ? width * store.batches() : 0);
  }
  states.begin_order(slots);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!flow_->has_water(std::int32_t(b))) continue;
    const ParticleStore<D, T>& store = bodies_[b].body->store();
    for (const auto& block : store.blocks()) {
      for (int i = 0; i < block.count; ++i) {
        const std::int32_t batch = block.batches[std::size_t(i / width)];
        const std::int64_t id = store.ids(batch)[i % width];
        if (id >= 0) states.put(int(b), std::int64_t(batch) * width + i % width, id);
      }
    }
  }
  flow_->end_order();
}

/// Pressures and volume ratios at t = 0.
template <int D, class T>
void SimulationImpl<D, T>::start_flow() {
  constexpr int width = ParticleStore<D, T>::width;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const State& state = bodies_[b];
    if (!flow_->has_water(std::int32_t(b))) continue;
    const std::vector<double>& pressure = setup_.bodies[b].pore_pressure;
    for (const auto& block : state.body->store().blocks()) {
      for (std::size_t k = 0; k < block.batches.size(); ++k) {
        const std::int32_t batch = block.batches[k];
        const int active = std::min(width, block.count - int(k) * width);
        double ratio[width], energy[width];
        state.body->evaluate(state.body->store().batch(batch), active, ratio, energy);
        for (int l = 0; l < active; ++l) {
          const std::int64_t id = state.body->store().ids(batch)[l];
          const std::size_t own = std::size_t(id - state.first_id);
          flow_->start(id, std::int32_t(b), pressure.empty() ? 0.0 : pressure[own], ratio[l]);
        }
      }
    }
  }
}

/// Masses as scattered, before faces fold them; but beyond periodic faces, which a body may just be
/// passing: there all ghosts of a node count as seen.
template <int D, class T>
void SimulationImpl<D, T>::note_masses() {
  if (!flow_) return;
  const AlignedVector<T>& nodes = backend_->momenta();
  std::vector<double>& mass = flow_->constraints().masses();
  mass.resize(nodes.size() / node_values);
  each_node(
      [&](std::size_t, std::size_t r) { mass[r] = double(nodes[r * node_values + mass_slot]); });
  backend_->updated_grid().update->move_periodic(mass);
}

/// The blocks of particles with water.
template <int D, class T>
auto SimulationImpl<D, T>::list_flow_chunks() -> std::vector<const FlowBlock*> {
  std::vector<FlowChunk<D>>& chunks = flow_->chunks();
  std::vector<const FlowBlock*> blocks;
  std::int64_t count = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!flow_->has_water(std::int32_t(b))) continue;
    for (const auto& block : bodies_[b].body->store().blocks()) {
      if (chunks.size() == blocks.size()) chunks.emplace_back();
      FlowChunk<D>& chunk = chunks[blocks.size()];
      chunk.begin = count;
      count += block.count;
      chunk.end = count;
      chunk.block = block_coord<D>(block.key);
      chunk.body = std::int32_t(b);
      blocks.push_back(&block);
    }
  }
  chunks.resize(blocks.size());
  return blocks;
}

/// The particles with water: first where they are, then all that hangs on it. follow: the pores go
/// through what has happened since the last points.
template <int D, class T>
void SimulationImpl<D, T>::collect_flow_points(bool follow) {
  const std::vector<const FlowBlock*> blocks = list_flow_chunks();
  flow_->begin_points(external_ && external_->has_tractions());
  executor_.pool().for_each(std::int64_t(blocks.size()), [&](std::int64_t c, int) {
    order_chunk(flow_->chunks()[std::size_t(c)], *blocks[std::size_t(c)]);
  });
  flow_->assemble(
      [&](std::int32_t c, FlowPoints<D>& points) {
        fill_chunk(flow_->chunks()[std::size_t(c)], *blocks[std::size_t(c)], follow, points);
      },
      executor_.pool());
}

template <int D, class T>
void SimulationImpl<D, T>::load_positions(const ParticleStore<D, T>& store, const FlowBlock& block,
                                          FlowVector<D>& vector) const {
  constexpr int width = ParticleStore<D, T>::width;
  const std::int32_t b = block.batches[std::size_t(vector.first / width)];
  const T* from = store.batch(b) + vector.first % width;
  vector.count = std::min(vector.width, block.count - vector.first);
  for (int a = 0; a < D; ++a) {
    widen(from + a * width, vector.position[a]);
    std::fill(vector.position[a] + vector.count, vector.position[a] + vector.width, 1.0);
  }
}

/// A vector of numbers in double precision.
template <int D, class T>
void SimulationImpl<D, T>::widen(const T* from, double* to) {
  if constexpr (sizeof(T) == sizeof(double)) {
    std::memcpy(to, from, sizeof(double) * FlowVector<D>::width);
  } else {
    for (int i = 0; i < FlowVector<D>::width; ++i) to[i] = double(from[i]);
  }
}

/// Asks memory for `fields` numbers of the particles from `first` on.
template <int D, class T>
void SimulationImpl<D, T>::fetch(const T* pool, int first, int fields) {
  for (int k = 0; k < fields; ++k) {
    __builtin_prefetch(pool + (first + k) * ParticleStore<D, T>::width, 0, 2);
  }
}

template <int D, class T>
void SimulationImpl<D, T>::order_chunk(FlowChunk<D>& chunk, const FlowBlock& block) {
  constexpr int width = ParticleStore<D, T>::width;
  constexpr std::size_t ahead = 6;  // positions lie too far apart to be seen coming
  const ParticleStore<D, T>& store = bodies_[std::size_t(chunk.body)].body->store();
  PointOrder<D>& order = flow_->order();
  FlowVector<D> vector;
  bool same = order.known();
  for (vector.first = 0; vector.first < block.count; vector.first += vector.width) {
    const std::size_t k = std::size_t(vector.first / width);
    if (vector.first % width == 0 && k + ahead < block.batches.size()) {
      fetch(store.batch(block.batches[k + ahead]), 0, D);
    }
    load_positions(store, block, vector);
    same &= order.note(chunk, vector.first, vector.count, vector.position);
  }
  if (!same) order.arrange(chunk);
}

template <int D, class T>
void SimulationImpl<D, T>::fill_chunk(const FlowChunk<D>& chunk, const FlowBlock& block,
                                      bool follow, FlowPoints<D>& points) {
  constexpr int width = ParticleStore<D, T>::width;
  const ParticleStore<D, T>& store = bodies_[std::size_t(chunk.body)].body->store();
  const std::int64_t first_place = flow_->states().first_place(chunk.body);
  FlowVector<D> vector{};
  for (vector.first = 0; vector.first < block.count; vector.first += vector.width) {
    constexpr int ahead = 4 * vector.width;
    if (vector.first + ahead < block.count) {
      const std::int32_t coming = block.batches[std::size_t((vector.first + ahead) / width)];
      const int lane = (vector.first + ahead) % width;
      fetch(store.batch(coming) + lane, 0, D);
      fetch(store.aux_batch(coming) + lane, layout_.increment, D * D);
      flow_->states().prefetch(first_place + std::int64_t(coming) * width + lane);
    }
    load_positions(store, block, vector);
    const std::int32_t b = block.batches[std::size_t(vector.first / width)];
    const int lane = vector.first % width;
    vector.place = first_place + std::int64_t(b) * width + lane;
    if (follow) load_changes(store, block, vector);
    flow_->fill(vector, chunk, points);
  }
  if (!points.moments.empty()) set_moments(chunk, points);
}

/// What has happened to the particles since the last points.
template <int D, class T>
void SimulationImpl<D, T>::load_changes(const ParticleStore<D, T>& store, const FlowBlock& block,
                                        FlowVector<D>& vector) const {
  constexpr int width = ParticleStore<D, T>::width;
  const std::int32_t b = block.batches[std::size_t(vector.first / width)];
  const int lane = vector.first % width;
  const T* aux = store.aux_batch(b) + lane;
  for (int k = 0; k < D * D; ++k) widen(aux + (layout_.increment + k) * width, vector.increment[k]);
  if (strides()) {
    widen(aux + stride_fields_.growth * width, vector.growth);
    return;
  }
  for (int i = 0; i < vector.count && flow_->keeps_increments(); ++i) {
    const auto& increment = flow_->increment(store.ids(b)[lane + i]);
    for (std::size_t k = 0; k < D * D; ++k) vector.increment[k][i] = increment[k];
  }
  set_growth(vector);
}

/// A traction acts on its face, not on the particle: beside the force that the particle scatters,
/// water needs its moment, or pressures next to a loaded surface alternate by half of the load.
template <int D, class T>
void SimulationImpl<D, T>::set_moments(const FlowChunk<D>& chunk, FlowPoints<D>& points) const {
  for (std::size_t i = 0; i < points.loaded.size(); ++i) {
    const std::int64_t id = flow_->states().id(points.place[i]);
    points.loaded[i] = external_->loaded(id) ? 1 : 0;
    if (points.loaded[i] == 0) continue;
    std::array<double, 3> x{};
    for (std::size_t a = 0; a < D; ++a) {
      x[a] =
          setup_.lower[a] + setup_.cell_size * (block_cells * chunk.block[a] + points.local[a][i]);
    }
    const Mat3<double> m = external_->moment(id, &reference_[3 * std::size_t(id)], x.data(),
                                             clock_.time, flow_->half_side(chunk.body));
    for (int k = 0; k < D * D; ++k) points.moments[i][std::size_t(k)] = m(k / D, k % D);
  }
}

/// The pores at the step's start.
template <int D, class T>
void SimulationImpl<D, T>::collect_flow() {
  if (!flow_) return;
  const auto start = std::chrono::steady_clock::now();
  backend_->give_particles();
  flow_->follow(backend_->grid().topology());
  collect_flow_points(true);
  time_phase(Phase::pressure, start);
}

/// Velocities under the effective stress -> velocities under the pore pressure too. False: the step
/// has to be tried again with half its length; it has been halved so many times already.
template <int D, class T>
bool SimulationImpl<D, T>::couple_flow(int halvings) {
  if (!flow_) return true;
  const auto start = std::chrono::steady_clock::now();
  const UpdatedGrid<D, T> grid = backend_->updated_grid();
  lend_velocities(*grid.velocities);
  FlowStep<D> step;
  step.dt = clock_.dt;
  step.end = clock_.next_time;
  const GridForces forces = grid_forces();
  step.gravity = forces.gravity;
  step.decisions.faces = &grid.update->faces();
  step.decisions.pairs = &grid.update->pairs();
  step.decisions.folded = &grid.update->folded();
  step.keep = forces.kept();
  step.colliders = &colliders_;
  step.touch = 64 * double(std::numeric_limits<T>::epsilon());
  step.record = setup_.record && setup_.schedule.record_due(step.end);
  step.begins = stride_.begins();
  step.may_go_on = strides() && stride_.longest() > 1;
  if (!flow_->solve(step, backend_->grid().topology(), executor_.pool())) {
    time_phase(Phase::pressure, start);
    if (halvings < flow_->most_halvings()) return false;
    throw RunFault(flow_->failure(step.end, halvings));
  }
  const double fastest = take_velocities();
  if (strides()) stride_.plan(clock_.dt * fastest / setup_.cell_size);
  flow_->end_step(step, stride_.ends(), executor_.pool());
  grid.update->add_reactions(flow_->reactions());
  time_phase(Phase::pressure, start);
  return true;
}

/// To the pore water: those of the grid, or copies where it has no double precision or needs to
/// know what they were.
template <int D, class T>
void SimulationImpl<D, T>::lend_velocities(AlignedVector<T>& nodes) {
  if constexpr (std::is_same_v<T, double>) {
    if (!separate_) {
      flow_->velocity() = {nodes.data(), node_values};
      return;
    }
  }
  lent_.resize(nodes.size() / node_values * D);
  flow_->velocity() = {lent_.data(), D};
  each_node([&](std::size_t, std::size_t r) {
    for (std::size_t a = 0; a < D; ++a) lent_[r * D + a] = double(nodes[r * node_values + a]);
  });
}

/// The velocities under the pressure, and what they do to the nodes within a stride. Returns the
/// largest component, which bounds those of the particles: weights are positive and sum to one.
template <int D, class T>
double SimulationImpl<D, T>::take_velocities() {
  const UpdatedGrid<D, T> grid = backend_->updated_grid();
  AlignedVector<T>& nodes = *grid.velocities;
  AlignedVector<T>& changes = *grid.changes;
  const bool copied = flow_->velocity().first == lent_.data() && !lent_.empty();
  const bool moves = strides() && stride_.longest() > 1;
  if (!copied && !moves) return 0;
  if (moves && stride_.begins()) changes.assign(nodes.size(), T(0));
  // One more than there are blocks: all particles may have left.
  std::vector<T> fastest(std::size_t(backend_->grid().topology().size()) + 1, T(0));
  each_node([&](std::size_t block, std::size_t r) {
    for (std::size_t a = 0; a < D; ++a) {
      T& v = nodes[r * node_values + a];
      if (copied) {
        const T changed = T(lent_[r * D + a]);
        if (separate_) changes[r * node_values + a] += changed - v;
        v = changed;
      }
      if (moves) changes[r * node_values + a] += T(clock_.dt) * v;
      fastest[block] = std::max(fastest[block], std::abs(v));
    }
  });
  return double(*std::max_element(fastest.begin(), fastest.end()));
}

/// Calls f(block, record) for all nodes, block by block on any thread.
template <int D, class T>
template <class F>
void SimulationImpl<D, T>::each_node(F&& f) const {
  const std::size_t count = backend_->grid().block_values() / node_values;
  executor_.pool().for_each(
      backend_->grid().topology().size(),
      [&](std::int64_t block, int) {
        const std::size_t begin = std::size_t(block) * count;
        for (std::size_t r = begin; r < begin + count; ++r) f(std::size_t(block), r);
      },
      16);
}

/// Before the pressures nothing of the step has reached particles or water: it begins again.
template <int D, class T>
void SimulationImpl<D, T>::halve_step() {
  clock_.dt *= 0.5;
  clock_.next_time = clock_.time + clock_.dt;
  for (Collider& collider : colliders_) collider.set_step(clock_.time, clock_.dt);
  flow_->note_halving();
}

template <int D, class T>
SimulationImpl<D, T>::~SimulationImpl() = default;

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
