// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"
#include "solver/simulation/simulation_impl.hpp"

namespace scree {
namespace {

template <int D, class T>
void save_particles(StateWriter& writer, const std::string& name,
                    const ParticleStore<D, T>& store) {
  constexpr int width = ParticleStore<D, T>::width;
  std::vector<std::int64_t> keys;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> counts;
  std::vector<T> records;
  for (const auto& block : store.blocks()) {
    keys.push_back(static_cast<std::int64_t>(block.key));
    counts.push_back(block.count);
    for (int i = 0; i < block.count; ++i) {
      const std::int32_t b = block.batches[std::size_t(i / width)];
      ids.push_back(store.ids(b)[i % width]);
      for (int f = 0; f < store.fields(); ++f)
        records.push_back(store.batch(b)[f * width + i % width]);
      for (int f = 0; f < store.aux_fields(); ++f) {
        records.push_back(store.aux_batch(b)[f * width + i % width]);
      }
    }
  }
  writer.put(name + "/block_keys", keys);
  writer.put(name + "/block_counts", counts);
  writer.put(name + "/ids", ids);
  writer.put(name + "/records", records);
}

template <int D, class T>
void load_particles(const StateReader& reader, const std::string& name,
                    ParticleStore<D, T>& store) {
  const auto keys = reader.get<std::int64_t>(name + "/block_keys");
  const auto counts = reader.get<std::int32_t>(name + "/block_counts");
  const auto ids = reader.get<std::int64_t>(name + "/ids");
  const auto records = reader.get<T>(name + "/records");
  const std::size_t stride = std::size_t(store.fields()) + std::size_t(store.aux_fields());
  if (keys.size() != counts.size() || records.size() != ids.size() * stride) {
    throw RunFault("the checkpoint's particles of " + name + " do not match this deck");
  }
  store.clear();
  store.reserve(std::int64_t(ids.size()) + std::int64_t(keys.size()) * ParticleStore<D, T>::width);
  std::size_t p = 0;
  for (std::size_t b = 0; b < keys.size(); ++b) {
    for (std::int32_t i = 0; i < counts[b]; ++i, ++p) {
      const std::int64_t slot = store.append(static_cast<std::uint64_t>(keys[b]), ids.at(p));
      const T* record = &records[p * stride];
      for (int f = 0; f < store.fields(); ++f) store.value(slot, f) = record[f];
      for (int f = 0; f < store.aux_fields(); ++f)
        store.aux_value(slot, f) = record[store.fields() + f];
    }
  }
  store.finish_blocks();
}

/// Those that are marked dead and not yet dropped.
template <int D, class T>
std::int64_t dead_particles(const ParticleStore<D, T>& store) {
  constexpr int width = ParticleStore<D, T>::width;
  std::int64_t dead = 0;
  for (const auto& block : store.blocks()) {
    for (int i = 0; i < block.count; ++i) {
      if (store.ids(block.batches[std::size_t(i / width)])[i % width] < 0) ++dead;
    }
  }
  return dead;
}

}  // namespace

template <int D, class T>
void SimulationImpl<D, T>::save(StateWriter& writer) const {
  writer.put("clock",
             std::vector<double>{clock_.time, clock_.dt, clock_.next_time, clock_.last_dt});
  writer.put("bounds",
             std::vector<double>{bounds_.max_speed, bounds_.max_signal, bounds_.max_excursion});
  writer.put("counters",
             std::vector<std::int64_t>{step_, removed_, pending_dead_, recorded_ ? 1 : 0});
  writer.put_value("scattered_mass", scattered_mass_);
  backend_->give_particles();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    save_particles(writer, fmt::format("body_{}", b), bodies_[b].body->store());
  }
  if (fused_) {
    const std::vector<std::uint64_t>& active = backend_->grid().topology().keys();
    const AlignedVector<T>& momenta = backend_->momenta();
    writer.put("grid/block_keys", std::vector<std::int64_t>(active.begin(), active.end()));
    writer.put("grid/momentum", std::span<const T>(momenta.data(), momenta.size()));
  }
  if (strides()) save_stride(writer);
  for (const Collider& collider : colliders_) collider.save(writer);
  writer.put("work/colliders", collider_work_);
  writer.put("work/loads", std::vector<double>{external_work_, external_power_});
  if (external_) external_->save(writer);
  if (flow_) flow_->save(writer);
}

/// How far the stride is.
template <int D, class T>
void SimulationImpl<D, T>::save_stride(StateWriter& writer) const {
  writer.put("stride", std::vector<double>{double(stride_.steps()), stride_.drift()});
  if (stride_.begins()) return;
  const AlignedVector<T>& moved = *backend_->updated_grid().changes;
  writer.put("grid/displacement", std::span<const T>(moved.data(), moved.size()));
}

/// The pores are those of the stride's start already.
template <int D, class T>
void SimulationImpl<D, T>::load_stride(const StateReader& reader) {
  const auto stride = reader.get<double>("stride");
  stride_.resume(int(stride.at(0)), stride.at(1));
  if (stride_.begins()) return;
  const auto moved = reader.get<T>("grid/displacement");
  if (moved.size() != backend_->grid().size()) {
    throw RunFault("the checkpoint's displacements do not match its grid");
  }
  backend_->updated_grid().changes->assign(moved.begin(), moved.end());
  flow_->follow(backend_->grid().topology());
  collect_flow_points(false);
  note_masses();
}

template <int D, class T>
void SimulationImpl<D, T>::load(const StateReader& reader) {
  const auto clock = reader.get<double>("clock");
  clock_ = {clock.at(0), clock.at(1), clock.at(2), clock.at(3)};
  const auto bounds = reader.get<double>("bounds");
  bounds_ = {bounds.at(0), bounds.at(1), bounds.at(2)};
  const auto counters = reader.get<std::int64_t>("counters");
  step_ = counters.at(0);
  removed_ = counters.at(1);
  pending_dead_ = counters.at(2);
  recorded_ = counters.at(3) != 0;
  scattered_mass_ = reader.get_value<double>("scattered_mass");
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    load_particles(reader, fmt::format("body_{}", b), bodies_[b].body->store());
    bodies_[b].dead = dead_particles(bodies_[b].body->store());
  }
  backend_->take_particles();
  if (fused_) {
    const auto keys = reader.get<std::int64_t>("grid/block_keys");
    const auto momentum = reader.get<T>("grid/momentum");
    const auto& active = backend_->grid().topology().keys();
    const auto same = [](std::int64_t a, std::uint64_t b) {
      return static_cast<std::uint64_t>(a) == b;
    };
    if (!std::equal(keys.begin(), keys.end(), active.begin(), active.end(), same) ||
        momentum.size() != backend_->grid().size()) {
      throw RunFault("the checkpoint's grid does not match its particles");
    }
    backend_->set_momenta(momentum);
  }
  for (Collider& collider : colliders_) collider.load(reader);
  collider_work_ = reader.get<double>("work/colliders");
  const auto loads = reader.get<double>("work/loads");
  external_work_ = loads.at(0);
  external_power_ = loads.at(1);
  if (external_) external_->load(reader);
  if (flow_) {
    flow_->load(reader);
    order_flow();
    if (strides()) load_stride(reader);
  }
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
