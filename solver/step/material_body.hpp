// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/pore_water.hpp"
#include "solver/base/error.hpp"
#include "solver/step/block_bodies.hpp"
#include "solver/step/body.hpp"
#include "solver/step/state_access.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {

/// The columns of a law's state, in order.
template <class Material>
std::vector<StateColumn> state_columns() {
  std::vector<StateColumn> columns;
  int first = 0;
  for (const auto& field : Material::fields()) {
    columns.push_back({field.name, field.unit, field.components, first, field.output});
    first += field.components;
  }
  return columns;
}

/// The entries of an undeformed state.
template <class Material, class T>
std::vector<T> initial_entries(const typename Material::template Params<T>& params) {
  using State = typename Material::template State<T>;
  const State state = Material::template initial<T>(params);
  std::vector<T> entries(std::size_t(state_entries<State, T>));
  __builtin_memcpy(entries.data(), &state, sizeof state);
  return entries;
}

/// Body of one law: the instances of the block bodies that contain material code.
template <class Material, int D, class T>
class MaterialBody final : public Body<D, T> {
 public:
  using Params = typename Material::template Params<T>;
  using State = typename Material::template State<T>;
  using typename Body<D, T>::Blocks;

  MaterialBody(BodyInfo info, const typename Material::Input& input)
      : Body<D, T>(info, state_entries<State, T> + (has_water(info) ? 1 : 0),
                   padding(info, Material::template params<T>(input, info.density, D)),
                   columns(info)),
        params_(Material::template params<T>(input, info.density, D)),
        exact_(Material::template params<double>(input, info.density, D)) {
    if (has_water(info) && !effective_stress<Material>) {
      throw UserError(info.model + " is no law of effective stresses: no undrained_bulk_modulus");
    }
  }

  void g2p2g(Executor& executor, const PassData<D, T>& data, const Blocks& blocks,
             KernelType kernel) const override {
    if (kernel == KernelType::compact) {
      fused<Compact>(executor, data, blocks);
    } else {
      fused<Quadratic>(executor, data, blocks);
    }
  }

  void stress(Executor& executor, const PassData<D, T>& data, const Blocks& blocks) const override {
    for_each_block<Linear>(executor, data, blocks,
                           [&](auto& group) { stress_block<Material>(group, data, params_); });
  }

  double initial_signal_speed(double cell_size) const override {
    const auto state = Material::template initial<double>(exact_);
    const double diffusion = diffusion_speed<Material, double, double>(exact_, state, D, cell_size);
    const double speed = Material::wave_speed(exact_, state);
    const BodyInfo& info = this->info();
    if (!has_water(info)) return speed + diffusion;
    return pore_water::wave_speed(speed, Material::volume_ratio(exact_, state),
                                  info.undrained_bulk_modulus / info.density);
  }

  void evaluate(const T* batch, int active, double* volume_ratio,
                double* energy_density) const override {
    constexpr int width = ParticleStore<D, T>::width;
    constexpr int entries = state_entries<State, T>;
    for (int l = 0; l < active; ++l) {
      double values[entries];
      for (int i = 0; i < entries; ++i) values[i] = double(batch[(D + i) * width + l]);
      typename Material::template State<double> state;
      static_assert(sizeof state == sizeof values);
      __builtin_memcpy(&state, values, sizeof state);
      volume_ratio[l] = Material::volume_ratio(exact_, state);
      energy_density[l] = Material::energy_density(exact_, state);
      if (!has_water(this->info())) continue;
      const double pressure = double(batch[(D + entries) * width + l]);
      energy_density[l] += pore_water::energy_density(volume_ratio[l], pressure,
                                                      this->info().undrained_bulk_modulus);
    }
  }

 private:
  static bool has_water(const BodyInfo& info) { return info.undrained_bulk_modulus > 0; }

  static std::vector<T> padding(const BodyInfo& info, const Params& params) {
    std::vector<T> fields(D, T(0));
    for (const T entry : initial_entries<Material, T>(params)) fields.push_back(entry);
    if (has_water(info)) fields.push_back(T(0));
    return fields;
  }

  static std::vector<StateColumn> columns(const BodyInfo& info) {
    std::vector<StateColumn> columns = state_columns<Material>();
    if (!has_water(info)) return columns;
    const StateField field = pore_water::field();
    columns.push_back(
        {field.name, field.unit, field.components, state_entries<State, T>, field.output});
    return columns;
  }

  template <class Kernel>
  void fused(Executor& executor, const PassData<D, T>& data, const Blocks& blocks) const {
    for_each_block<Kernel>(executor, data, blocks, [&](auto& group) {
      g2p2g_block<Kernel, Material>(group, data, params_);
    });
  }

  Params params_;
  typename Material::template Params<double> exact_;
};

}  // namespace scree
