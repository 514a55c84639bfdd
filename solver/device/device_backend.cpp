// SPDX-License-Identifier: Apache-2.0
#include "solver/device/device_backend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "solver/base/error.hpp"

namespace scree {
namespace {

std::vector<std::uint64_t> sorted_without_doubles(std::vector<std::uint64_t> keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

}  // namespace

template <int D, class T>
DeviceBackend<D, T>::DeviceBackend(const BackendConfig<D>& config, const AuxLayout& layout,
                                   Bodies& bodies, ThreadPool& pool, const DeviceToolkit& toolkit,
                                   const std::vector<BodySetup>& setups)
    : config_(config),
      layout_(layout),
      bodies_(bodies),
      pool_(pool),
      toolkit_(toolkit),
      device_(toolkit.open()),
      kernels_(toolkit.parts<D, T>().kernels()),
      grid_(*device_, *kernels_, config),
      read_back_(*device_, "reports") {
  for (const BodySetup& setup : setups) {
    laws_.push_back(toolkit.parts<D, T>().law(setup.model, setup.input, setup.density));
    particles_.emplace_back(*device_, *kernels_);
  }
  resize_read_back(0);
}

/// What the run's start will take.
template <int D, class T>
MemoryNeed DeviceBackend<D, T>::memory_need() const {
  MemoryNeed need;
  need.free = std::int64_t(device_->free_memory());
  std::vector<std::uint64_t> occupied;
  for (const BodyState<D, T>& state : bodies_) {
    const ParticleStore<D, T>& store = state.body->store();
    for (const auto& block : store.blocks()) occupied.push_back(block.key);
    need.particles += store.count();
    need.bytes += DeviceParticles<D, T>::needed_bytes(
        store.count(), std::int64_t(store.blocks().size()), store.fields(), store.aux_fields());
  }
  need.bytes += grid_.needed_bytes(sorted_without_doubles(std::move(occupied)));
  return need;
}

/// It must fit before anything is allocated.
template <int D, class T>
void DeviceBackend<D, T>::check_memory() const {
  const MemoryNeed need = memory_need();
  toolkit_.tell(need);
  if (need.bytes <= need.free) return;
  throw UserError(fmt::format(
      "{} particles need at least {:.2f} GB of the device's memory ({} bytes each), and {} "
      "has {:.2f} GB free; use fewer particles, precision = \"single\", or --backend cpu",
      need.particles, double(need.bytes) * 1e-9,
      need.bytes / std::max<std::int64_t>(need.particles, 1), device_->name(),
      double(need.free) * 1e-9));
}

template <int D, class T>
void DeviceBackend<D, T>::take_particles() {
  check_memory();
  for (std::size_t i = 0; i < bodies_.size(); ++i) particles_[i].take(bodies_[i].body->store());
  find_blocks(false);
  find_loaded();
  stores_are_old_ = false;
}

template <int D, class T>
void DeviceBackend<D, T>::give_particles() {
  if (!stores_are_old_) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) particles_[i].give(bodies_[i].body->store());
  stores_are_old_ = false;
}

template <int D, class T>
void DeviceBackend<D, T>::take_aux(int first, int count) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    particles_[i].take_aux(bodies_[i].body->store(), first, count);
  }
}

template <int D, class T>
void DeviceBackend<D, T>::set_layout(const AuxLayout& layout) {
  give_particles();
  for (std::size_t i = 0; i < bodies_.size() && layout.total != layout_.total; ++i) {
    bodies_[i].body->store().resize_aux(layout.total);
    particles_[i].resize_aux(layout.total);
  }
  layout_ = layout;
}

/// Rebuilds what hangs on the set of blocks.
template <int D, class T>
void DeviceBackend<D, T>::find_blocks(bool carry) {
  std::vector<std::uint64_t> occupied;
  for (const DeviceParticles<D, T>& particles : particles_) {
    occupied.insert(occupied.end(), particles.keys().begin(), particles.keys().end());
  }
  grid_.rebuild(sorted_without_doubles(std::move(occupied)), carry);
  for (DeviceParticles<D, T>& particles : particles_) {
    particles.find_grid_blocks(grid_.blocks().topology());
  }
}

template <int D, class T>
void DeviceBackend<D, T>::bin(const std::array<std::int32_t, D>& wrap) {
  bool changed = false;
  for (DeviceParticles<D, T>& particles : particles_) changed |= particles.bin(wrap);
  if (changed) find_blocks(config_.fused);
  find_loaded();
  stores_are_old_ = true;
}

template <int D, class T>
void DeviceBackend<D, T>::find_loaded() {
  for (std::size_t i = 0; i < chosen_.size(); ++i) chosen_[i].find(particles_[i]);
}

template <int D, class T>
bool DeviceBackend<D, T>::load_only(const std::vector<std::int64_t>& ids) {
  chosen_.clear();
  auto first = ids.begin();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto end = i + 1 < bodies_.size()
                         ? std::lower_bound(first, ids.end(), bodies_[i + 1].first_id)
                         : ids.end();
    chosen_.emplace_back(*device_, *kernels_, std::vector<std::int64_t>(first, end));
    first = end;
  }
  find_loaded();
  return true;
}

template <int D, class T>
std::vector<LoadedParticle<D>>& DeviceBackend<D, T>::read_loaded() {
  loaded_.clear();
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    chosen_[i].read(pass_data(i, {}), int(i), loaded_);
  }
  return loaded_;
}

template <int D, class T>
void DeviceBackend<D, T>::write_loaded() {
  const LoadedParticle<D>* from = loaded_.data();
  for (std::size_t i = 0; i < chosen_.size(); ++i) from = chosen_[i].write(pass_data(i, {}), from);
  stores_are_old_ = true;
}

template <int D, class T>
PassData<D, T> DeviceBackend<D, T>::pass_data(std::size_t body,
                                              const PassParameters<T>& parameters) const {
  PassData<D, T> data = particles_[body].data();
  data.parameters = parameters;
  data.layout = layout_;
  data.neighbours = grid_.neighbours();
  data.read[0] = grid_.current.data();
  data.read[1] = grid_.extra.data();
  data.write[0] = grid_.current.data();
  data.write[1] = grid_.extra.data();
  return data;
}

template <int D, class T>
void DeviceBackend<D, T>::p2g(const Parameters& parameters) {
  if (config_.deterministic) return p2g_fixed(parameters);
  grid_.clear(grid_.current);
  if (config_.separate_force) grid_.clear(grid_.extra);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    kernels_->p2g(config_.kernel, config_.transfer, pass_data(i, parameters[i]),
                  particles_[i].blocks());
  }
}

template <int D, class T>
void DeviceBackend<D, T>::p2g_fixed(const Parameters& parameters) {
  double mass = 0;
  for (const PassParameters<T>& p : parameters) mass = std::max(mass, double(p.particle_mass));
  const FixedChannels sums =
      grid_.fixed_sums(mass, config_.cell_size / double(parameters[0].dt_next));
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    kernels_->p2g_fixed(config_.kernel, config_.transfer, pass_data(i, parameters[i]), sums,
                        particles_[i].blocks());
  }
  grid_.take(sums);
}

template <int D, class T>
void DeviceBackend<D, T>::update_grid(const GridForces& forces, std::vector<Collider>& colliders) {
  if (colliders.size() != colliders_) resize_read_back(colliders.size());
  grid_.update(forces, colliders, pool_, mass_there(), reactions_there());
  update_dt_ = forces.dt;
  updated_ = true;
}

template <int D, class T>
void DeviceBackend<D, T>::g2p(const Parameters& parameters) {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    kernels_->g2p(config_.kernel, config_.transfer, pass_data(i, parameters[i]),
                  particles_[i].blocks());
  }
  stores_are_old_ = true;
}

template <int D, class T>
void DeviceBackend<D, T>::stress(const Parameters& parameters) {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    laws_[i]->stress(pass_data(i, parameters[i]), particles_[i].blocks());
  }
  stores_are_old_ = true;
}

template <int D, class T>
void DeviceBackend<D, T>::g2p2g(const Parameters& parameters) {
  grid_.clear(grid_.next);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    PassData<D, T> data = pass_data(i, parameters[i]);
    data.write[0] = grid_.next.data();
    laws_[i]->g2p2g(config_.kernel, data, particles_[i].blocks());
  }
  std::swap(grid_.current, grid_.next);
  stores_are_old_ = true;
}

template <int D, class T>
void DeviceBackend<D, T>::resize_read_back(std::size_t colliders) {
  colliders_ = colliders;
  const std::size_t numbers = (1 + 6 * colliders) * sizeof(double);
  read_back_.resize(particles_.size() * sizeof(BodySummary<T>) + numbers);
}

template <int D, class T>
double* DeviceBackend<D, T>::mass_there() const {
  static_assert(sizeof(BodySummary<T>) % sizeof(double) == 0);
  return reinterpret_cast<double*>(read_back_.data() + particles_.size() * sizeof(BodySummary<T>));
}

template <int D, class T>
PassReport<D> DeviceBackend<D, T>::report() {
  auto* summaries = reinterpret_cast<BodySummary<T>*>(read_back_.data());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    kernels_->summarise(particles_[i].data().results, particles_[i].blocks(), summaries + i);
  }
  std::vector<unsigned char> bytes;
  read_back_.download(bytes);
  PassReport<D> report;
  report.dead.assign(particles_.size(), 0);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    BodySummary<T> summary;
    std::memcpy(&summary, bytes.data() + i * sizeof summary, sizeof summary);
    add_summary(summary, int(i), report);
  }
  std::vector<double> numbers(1 + 6 * colliders_);
  std::memcpy(numbers.data(), bytes.data() + particles_.size() * sizeof(BodySummary<T>),
              numbers.size() * sizeof(double));
  report.grid_mass = numbers[0];
  if (std::exchange(updated_, false)) read_reactions(numbers.data() + 1);
  return report;
}

template <int D, class T>
void DeviceBackend<D, T>::read_reactions(const double* values) {
  reactions_.assign(colliders_, Reaction{});
  const double scale = 1 / (grid_.blocks().lattices() * update_dt_);
  for (std::size_t c = 0; c < colliders_; ++c) {
    for (std::size_t a = 0; a < 3; ++a) {
      reactions_[c].force[a] = values[6 * c + a] * scale;
      reactions_[c].torque[a] = values[6 * c + 3 + a] * scale;
    }
  }
}

template <int D, class T>
void DeviceBackend<D, T>::add_summary(const BodySummary<T>& summary, int body,
                                      PassReport<D>& report) const {
  const std::vector<std::uint64_t>& keys = particles_[std::size_t(body)].keys();
  const auto coord = [&](std::int32_t block) { return block_coord<D>(keys[std::size_t(block)]); };
  const auto raise = [&](double& most, double value, std::int32_t block, BlockPlace<D>& place) {
    if (block < 0 || !(value > most)) return;
    most = value;
    place = {body, coord(block)};
  };
  raise(report.max_speed, double(summary.max_speed), summary.fastest, report.fastest);
  raise(report.max_signal, double(summary.max_signal), summary.stiffest, report.stiffest);
  report.max_excursion = std::max(report.max_excursion, double(summary.max_excursion));
  report.dead[std::size_t(body)] = summary.dead;
  if (summary.fault_block < 0 || report.fault.code != FaultCode::none) return;
  const BlockResult<T>& result = summary.fault;
  report.fault = {result.fault,
                  body,
                  coord(summary.fault_block),
                  result.fault_id,
                  double(result.fault_value),
                  {}};
  for (std::size_t a = 0; a < D; ++a) report.fault.position[a] = double(result.fault_position[a]);
}

template <int D, class T>
const AlignedVector<T>& DeviceBackend<D, T>::velocities() {
  (config_.fused ? grid_.next : grid_.current).download(channel_);
  return channel_;
}

template <int D, class T>
const AlignedVector<T>& DeviceBackend<D, T>::momenta() {
  grid_.current.download(channel_);
  return channel_;
}

template <int D, class T>
void DeviceBackend<D, T>::set_momenta(const std::vector<T>& values) {
  grid_.current.upload(values);
}

template <int D, class T>
std::int64_t DeviceBackend<D, T>::other_bytes() const {
  std::int64_t total = std::int64_t(read_back_.bytes());
  for (const DeviceParticles<D, T>& particles : particles_) total += particles.bytes();
  for (const ChosenParticles<D, T>& chosen : chosen_) total += chosen.bytes();
  return total;
}

template class DeviceBackend<2, float>;
template class DeviceBackend<2, double>;
template class DeviceBackend<3, float>;
template class DeviceBackend<3, double>;

}  // namespace scree
