// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/coupled_flow.hpp"
#include "solver/simulation/simulation_impl.hpp"

namespace scree {

/// Where a particle is. (Within a stride of pore water it is ahead of its position.)
template <int D, class T>
std::array<double, 3> SimulationImpl<D, T>::position_of(std::uint64_t key,
                                                        const ParticleStore<D, T>& store,
                                                        std::int32_t batch, int lane) const {
  constexpr int width = ParticleStore<D, T>::width;
  const BlockCoord<D> block = block_coord<D>(key);
  std::array<double, 3> x{};
  for (int a = 0; a < D; ++a) {
    double u = double(store.batch(batch)[a * width + lane]);
    if (stride_fields_.ahead >= 0)
      u += double(store.aux_batch(batch)[(stride_fields_.ahead + a) * width + lane]);
    x[std::size_t(a)] = setup_.lower[std::size_t(a)] +
                        setup_.cell_size * (double(block_cells) * block[std::size_t(a)] + u);
  }
  return x;
}

/// Power of the last step's loads at the particles' present velocities [W]. The aux fields of the
/// bodies' stores must be up to date.
template <int D, class T>
double SimulationImpl<D, T>::external_power() const {
  constexpr int width = ParticleStore<D, T>::width;
  double power = 0;
  for (const State& state : bodies_) {
    const ParticleStore<D, T>& store = state.body->store();
    double sum = 0;
    for (const auto& block : store.blocks()) {
      for (int i = 0; i < block.count; ++i) {
        const std::int32_t b = block.batches[std::size_t(i / width)];
        const int lane = i % width;
        if (store.ids(b)[lane] < 0) continue;  // left through an open face
        const T* aux = store.aux_batch(b);
        for (int a = 0; a < D; ++a) {
          sum += double(aux[(layout_.external + a) * width + lane]) *
                 double(aux[(layout_.velocity + a) * width + lane]);
        }
      }
    }
    power += sum * state.body->info().particle_mass();
  }
  return power;
}

/// Work of the loads on particles up to time() [J]. A load is constant over a step and changes the
/// velocity linearly, so that the mean of its powers at both ends of the step is exact.
template <int D, class T>
double SimulationImpl<D, T>::external_work(double power_at_end) const {
  return external_work_ + 0.5 * clock_.last_dt * (external_power_ + power_at_end);
}

/// Work of the colliders in this step: the forces on them are the opposite of those on the
/// particles.
template <int D, class T>
void SimulationImpl<D, T>::note_collider_work() {
  const std::vector<Reaction>& reactions = backend_->reactions();
  for (std::size_t c = 0; c < reactions.size(); ++c) {
    for (int a = 0; a < D; ++a)
      collider_work_[c] -= clock_.dt * reactions[c].force[a] * colliders_[c].velocity()[a];
  }
}

/// Forces on particles at the step's start.
template <int D, class T>
void SimulationImpl<D, T>::update_external() {
  if (layout_.external < 0) return;
  const auto start = std::chrono::steady_clock::now();
  if (loads_alone_) {
    update_loads_alone();
    time_phase(Phase::external, start);
    return;
  }
  backend_->give_particles();
  if (external_) {
    external_work_ = external_work(external_power());
    update_loads();
  }
  add_gained_weight(gravity_of(clock_.time, clock_.dt));
  if (external_) external_power_ = external_power();
  backend_->take_aux(layout_.external, D);
  time_phase(Phase::external, start);
}

/// Evaluates body forces and tractions, after following the deformation of the loaded particles
/// over the last step.
template <int D, class T>
void SimulationImpl<D, T>::update_loads() {
  constexpr int width = ParticleStore<D, T>::width;
  for (State& state : bodies_) {
    ParticleStore<D, T>& store = state.body->store();
    for (const auto& block : store.blocks()) {
      for (int i = 0; i < block.count; ++i) {
        const std::int32_t b = block.batches[std::size_t(i / width)];
        const int lane = i % width;
        const std::int64_t id = store.ids(b)[lane];
        T* aux = store.aux_batch(b);
        if (external_->loaded(id)) {
          Mat3<double> increment = zero3<double>();
          for (int k = 0; k < D * D; ++k) {
            increment(k / D, k % D) = double(aux[(layout_.increment + k) * width + lane]);
          }
          external_->deform(id, increment);
        }
        const std::array<double, 3> x = position_of(block.key, store, b, lane);
        const std::array<double, 3> f =
            external_->acceleration(id, &reference_[3 * std::size_t(id)], x.data(), clock_.time);
        for (int a = 0; a < D; ++a)
          aux[(layout_.external + a) * width + lane] = T(f[std::size_t(a)]);
      }
    }
  }
}

/// The same where the backend brings the loaded particles alone.
template <int D, class T>
void SimulationImpl<D, T>::update_loads_alone() {
  std::vector<LoadedParticle<D>>& particles = backend_->read_loaded();
  const auto power = [&] {
    double sum = 0;
    for (const LoadedParticle<D>& p : particles) {
      const double mass = bodies_[std::size_t(p.body)].body->info().particle_mass();
      for (std::size_t a = 0; a < D; ++a) sum += mass * p.acceleration[a] * p.velocity[a];
    }
    return sum;
  };
  external_work_ = external_work(power());
  for (LoadedParticle<D>& p : particles) {
    Mat3<double> increment = zero3<double>();
    for (int k = 0; k < D * D; ++k) increment(k / D, k % D) = p.increment[std::size_t(k)];
    external_->deform(p.id, increment);
    std::array<double, 3> x{};
    for (std::size_t a = 0; a < D; ++a) x[a] = setup_.lower[a] + setup_.cell_size * p.cells[a];
    const std::array<double, 3> f =
        external_->acceleration(p.id, &reference_[3 * std::size_t(p.id)], x.data(), clock_.time);
    // As the backend keeps it.
    for (std::size_t a = 0; a < D; ++a) p.acceleration[a] = double(T(f[a]));
  }
  external_power_ = power();
  backend_->write_loaded();
}

/// For a fused stride, which makes a force of it in every step.
template <int D, class T>
void SimulationImpl<D, T>::weigh_gained_water() {
  if (stride_fields_.gained < 0) return;
  const auto start = std::chrono::steady_clock::now();
  each_gain([&](T* aux, const double* share) {
    constexpr int width = ParticleStore<D, T>::width, lanes = PoreStates<D>::width;
    T* gained = aux + stride_fields_.gained * width;
    for (int i = 0; i < lanes; ++i) gained[i] = T(share[i]);
  });
  backend_->take_aux(stride_fields_.gained, 1);
  time_phase(Phase::external, start);
}

/// Particles keep their mass; the weight of the water that they have gained since the start, or
/// lost, is a force.
template <int D, class T>
void SimulationImpl<D, T>::add_gained_weight(const std::array<double, 3>& gravity) {
  if (!flow_ || !setup_.gravity) return;
  each_gain([&](T* aux, const double* share) {
    constexpr int width = ParticleStore<D, T>::width, lanes = PoreStates<D>::width;
    T* force = aux + layout_.external * width;
    for (int a = 0; a < D; ++a) {
      for (int i = 0; i < lanes; ++i) {
        const double load = external_ ? double(force[a * width + i]) : 0.0;
        force[a * width + i] = T(load + share[i] * gravity[std::size_t(a)]);
      }
    }
  });
}

/// Calls f(aux, share) for each vector of particles: the first of its aux fields, and the mass of
/// gained water over the mass of the particle. Any thread, once a vector.
template <int D, class T>
template <class F>
void SimulationImpl<D, T>::each_gain(F&& f) {
  constexpr int width = ParticleStore<D, T>::width, lanes = PoreStates<D>::width;
  for (State& state : bodies_) {
    const BodyInfo& info = state.body->info();
    ParticleStore<D, T>& store = state.body->store();
    const bool water = flow_->has_water(info.body_index);
    const double per_mass = 1 / info.particle_mass();
    const std::int64_t first_place = flow_->states().first_place(info.body_index);
    executor_.pool().for_each(std::int64_t(store.blocks().size()), [&](std::int64_t n, int) {
      const auto& block = store.blocks()[std::size_t(n)];
      for (int first = 0; first < block.count; first += lanes) {
        const std::int32_t b = block.batches[std::size_t(first / width)];
        const int lane = first % width;
        alignas(64) double share[lanes] = {};
        if (water) {
          constexpr int ahead = 4 * lanes;
          const std::int64_t place = first_place + std::int64_t(b) * width + lane;
          if (first + ahead < block.count) {
            const std::int32_t coming = block.batches[std::size_t((first + ahead) / width)];
            flow_->states().prefetch_gain(first_place + std::int64_t(coming) * width + lane);
          }
          scree::store(share, flow_->gained_mass(info.body_index, place) * per_mass);
        }
        f(store.aux_batch(b) + lane, static_cast<const double*>(share));
      }
    });
  }
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
