// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/simulation_impl.hpp"

namespace scree {

template <int D, class T>
std::array<double, 3> SimulationImpl<D, T>::position_of(std::uint64_t key, const T* batch,
                                                        int lane) const {
  const BlockCoord<D> block = block_coord<D>(key);
  std::array<double, 3> x{};
  for (int a = 0; a < D; ++a) {
    const double u = double(batch[a * ParticleStore<D, T>::width + lane]);
    x[std::size_t(a)] = setup_.lower[std::size_t(a)] +
                        setup_.cell_size * (double(block_cells) * block[std::size_t(a)] + u);
  }
  return x;
}

/// Evaluates body forces and tractions at the step's start, after following the deformation of the
/// loaded particles over the last step.
template <int D, class T>
void SimulationImpl<D, T>::update_external() {
  if (!external_) return;
  constexpr int width = ParticleStore<D, T>::width;
  const auto start = std::chrono::steady_clock::now();
  backend_->give_particles();
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
        const std::array<double, 3> x = position_of(block.key, store.batch(b), lane);
        const std::array<double, 3> f =
            external_->acceleration(id, &reference_[3 * std::size_t(id)], x.data(), clock_.time);
        for (int a = 0; a < D; ++a)
          aux[(layout_.external + a) * width + lane] = T(f[std::size_t(a)]);
      }
    }
  }
  backend_->take_aux(layout_.external, D);
  time_phase(Phase::external, start);
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
