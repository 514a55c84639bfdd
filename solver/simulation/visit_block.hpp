// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "solver/coupling/coupled_flow.hpp"
#include "solver/simulation/particle_view.hpp"
#include "solver/simulation/simulation_impl.hpp"

namespace scree {

/// Coupled pore water: its share of the stress and its own quantities.
template <int D, class T>
void SimulationImpl<D, T>::add_flow(const BodyInfo& info, ParticleView& view) const {
  if (!flow_->has_water(info.body_index)) return;
  view.pore_pressure = flow_->pressure(view.id);
  view.biot = flow_->biot(info.body_index);
  view.porosity = flow_->porosity(info.body_index, view.id, view.volume_ratio);
  view.seepage = flow_->seepage(view.id);
  view.fluid_mass = flow_->fluid_mass(info.body_index, view.id, view.volume_ratio);
  for (const std::size_t i : {0, 3, 5}) {
    view.kirchhoff[i] -= view.biot * view.volume_ratio * *view.pore_pressure;
  }
}

/// Calls f(view) for every living particle of one block.
template <int D, class T>
template <class F>
void SimulationImpl<D, T>::visit_block(const State& state, std::size_t number, F&& f) const {
  constexpr int width = ParticleStore<D, T>::width;
  const ParticleStore<D, T>& store = state.body->store();
  const auto& block = store.blocks()[number];
  const bool water = state.body->info().undrained_bulk_modulus > 0;  // its pressure comes last
  for (std::size_t k = 0; k < block.batches.size(); ++k) {
    const std::int32_t b = block.batches[k];
    const int active = std::min(width, block.count - int(k) * width);
    double volume_ratio[width];
    double energy[width];
    state.body->evaluate(store.batch(b), active, volume_ratio, energy);
    for (int l = 0; l < active; ++l) {
      if (store.ids(b)[l] < 0) continue;
      ParticleView view;
      view.id = store.ids(b)[l];
      view.position = position_of(block.key, store, b, l);
      view.volume_ratio = volume_ratio[l];
      view.energy_density = energy[l];
      const T* aux = store.aux_batch(b);
      const auto value = [&](int field) { return double(aux[field * width + l]); };
      for (int c = 0; c < D; ++c) {
        view.velocity[std::size_t(c)] = value(layout_.velocity + c);
        for (int a = 0; a < D; ++a) {
          view.affine[c][a] = value(layout_.affine + c * D + a) * setup_.cell_size;
        }
      }
      for (int i = 0; i < 6; ++i) view.kirchhoff[std::size_t(i)] = value(layout_.stress + i);
      if (water) view.pore_pressure = double(store.batch(b)[(store.fields() - 1) * width + l]);
      if (flow_) add_flow(state.body->info(), view);
      view.batch = b;
      view.lane = l;
      f(view);
    }
  }
}

}  // namespace scree
