// SPDX-License-Identifier: Apache-2.0
#include "solver/exec/arena.hpp"
#include "solver/simulation/simulation_impl.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {

/// Counted from what the fused step does, line by line of its passes; that of pore water is not.
template <int D, class T>
StepTraffic SimulationImpl<D, T>::traffic() const {
  if (!fused_ || device_ || flow_) return {};
  constexpr std::int64_t record = node_values * sizeof(T);
  const int arena_nodes = setup_.kernel == KernelType::compact ? ArenaShape<Compact, D>::nodes
                                                               : ArenaShape<Quadratic, D>::nodes;
  constexpr int arena_accesses = 3;  // read the velocities; read and write the sums
  constexpr int grid_accesses = 5;   // forces: read, write; division: read, write; clear: write
  StepTraffic traffic;
  for (const State& state : bodies_) {
    const ParticleStore<D, T>& store = state.body->store();
    const auto batches = std::int64_t(store.batch_list().size());
    traffic.particles += 2 * batches * store.fields() * ParticleStore<D, T>::width *
                         std::int64_t(sizeof(T));  // read and written once, padding too
    traffic.grid += std::int64_t(store.blocks().size()) * arena_nodes * record * arena_accesses;
  }
  traffic.grid += std::int64_t(backend_->grid().size() * sizeof(T)) * grid_accesses;
  return traffic;
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
