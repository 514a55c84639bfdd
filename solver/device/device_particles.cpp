// SPDX-License-Identifier: Apache-2.0
#include "solver/device/device_particles.hpp"

#include <algorithm>
#include <utility>

#include "solver/device/pool_entry.hpp"

namespace scree {
namespace {

constexpr std::uint64_t no_key = ~std::uint64_t(0);

std::size_t entry(std::int64_t lane, int fields) { return std::size_t(pool_entry(lane, fields)); }

/// f(slot in the store, lane on the device) for all particles of a store.
template <int D, class T, class F>
void each_lane(const ParticleStore<D, T>& store, const std::vector<std::int32_t>& batch_begin,
               F&& f) {
  constexpr int width = ParticleStore<D, T>::width;
  std::size_t b = 0;
  for (const auto& block : store.blocks()) {
    const std::int64_t first = std::int64_t(batch_begin[b++]) * device_width;
    for (int i = 0; i < block.count; ++i) {
      f(std::int64_t(block.batches[std::size_t(i / width)]) * width + i % width, first + i);
    }
  }
}

template <int D, class T>
const T* field_of(const ParticleStore<D, T>& store, std::int64_t slot) {
  constexpr int width = ParticleStore<D, T>::width;
  return store.batch(std::int32_t(slot / width)) + slot % width;
}

template <int D, class T>
const T* aux_of(const ParticleStore<D, T>& store, std::int64_t slot) {
  constexpr int width = ParticleStore<D, T>::width;
  return store.aux_batch(std::int32_t(slot / width)) + slot % width;
}

}  // namespace

template <int D, class T>
DeviceParticles<D, T>::DeviceParticles(Device& device, DeviceKernels<D, T>& kernels)
    : device_(device),
      kernels_(kernels),
      pools_(make_pools()),
      spare_(make_pools()),
      counts_there_(device, "blocks"),
      batch_begin_there_(device, "blocks"),
      coords_(device, "blocks"),
      grid_block_(device, "blocks"),
      results_(device, "blocks"),
      sort_keys_(device, "sorting particles"),
      order_(device, "sorting particles"),
      first_(device, "blocks"),
      run_keys_(device, "sorting particles"),
      run_lengths_(device, "sorting particles") {}

template <int D, class T>
auto DeviceParticles<D, T>::make_pools() const -> Pools {
  return {DeviceArray<T>(device_, "particles"), DeviceArray<T>(device_, "particles"),
          DeviceArray<std::int64_t>(device_, "particles")};
}

template <int D, class T>
ParticlePools<T> DeviceParticles<D, T>::view(const Pools& pools) const {
  return {pools.particles.data(), pools.aux.data(), pools.ids.data(), fields_, aux_fields_};
}

template <int D, class T>
void DeviceParticles<D, T>::resize(Pools& pools, std::int64_t batches) const {
  const std::size_t lanes = std::size_t(batches) * width;
  pools.particles.resize(lanes * std::size_t(fields_));
  pools.aux.resize(lanes * std::size_t(aux_fields_));
  pools.ids.resize(lanes);
}

template <int D, class T>
void DeviceParticles<D, T>::set_blocks(std::vector<std::uint64_t> keys,
                                       std::vector<std::int32_t> counts) {
  keys_ = std::move(keys);
  counts_ = std::move(counts);
  count_ = 0;
  batch_begin_.assign(1, 0);
  std::vector<std::int32_t> coords;
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    count_ += counts_[b];
    batch_begin_.push_back(batch_begin_.back() + (counts_[b] + width - 1) / width);
    for (const std::int32_t c : block_coord<D>(keys_[b])) coords.push_back(c);
  }
  counts_there_.upload(counts_);
  batch_begin_there_.upload(batch_begin_);
  coords_.upload(coords);
  results_.resize(keys_.size());
  results_.upload(std::vector<BlockResult<T>>(keys_.size()));
}

template <int D, class T>
void DeviceParticles<D, T>::take(const Store& store) {
  fields_ = store.fields();
  aux_fields_ = store.aux_fields();
  std::vector<std::uint64_t> keys;
  std::vector<std::int32_t> counts;
  for (const auto& block : store.blocks()) {
    keys.push_back(block.key);
    counts.push_back(block.count);
  }
  set_blocks(std::move(keys), std::move(counts));
  const std::size_t lanes = std::size_t(batches()) * width;
  std::vector<T> particles(lanes * std::size_t(fields_), T(0));
  std::vector<T> aux(lanes * std::size_t(aux_fields_), T(0));
  std::vector<std::int64_t> ids(lanes, -1);
  each_lane(store, batch_begin_, [&](std::int64_t slot, std::int64_t lane) {
    ids[std::size_t(lane)] = store.ids(0)[slot];
    for (int f = 0; f < fields_; ++f) {
      particles[entry(lane, fields_) + std::size_t(f * width)] =
          field_of(store, slot)[f * Store::width];
    }
    for (int f = 0; f < aux_fields_; ++f) {
      aux[entry(lane, aux_fields_) + std::size_t(f * width)] =
          aux_of(store, slot)[f * Store::width];
    }
  });
  pools_.particles.upload(particles);
  pools_.aux.upload(aux);
  pools_.ids.upload(ids);
}

template <int D, class T>
void DeviceParticles<D, T>::give(Store& store) const {
  std::vector<T> particles;
  std::vector<T> aux;
  std::vector<std::int64_t> ids;
  pools_.particles.download(particles);
  pools_.aux.download(aux);
  pools_.ids.download(ids);
  store.clear();
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    for (int i = 0; i < counts_[b]; ++i) {
      const std::int64_t lane = std::int64_t(batch_begin_[b]) * width + i;
      const std::int64_t slot = store.append(keys_[b], ids[std::size_t(lane)]);
      for (int f = 0; f < fields_; ++f) {
        store.value(slot, f) = particles[entry(lane, fields_) + std::size_t(f * width)];
      }
      for (int f = 0; f < aux_fields_; ++f) {
        store.aux_value(slot, f) = aux[entry(lane, aux_fields_) + std::size_t(f * width)];
      }
    }
  }
  store.finish_blocks();
}

template <int D, class T>
void DeviceParticles<D, T>::take_aux(const Store& store, int first, int count) {
  std::vector<T> aux;
  pools_.aux.download(aux);
  each_lane(store, batch_begin_, [&](std::int64_t slot, std::int64_t lane) {
    for (int f = first; f < first + count; ++f) {
      aux[entry(lane, aux_fields_) + std::size_t(f * width)] =
          aux_of(store, slot)[f * Store::width];
    }
  });
  pools_.aux.upload(aux);
}

template <int D, class T>
void DeviceParticles<D, T>::resize_aux(int aux_fields) {
  aux_fields_ = aux_fields;
  pools_.aux.free();
  spare_.aux.free();
  pools_.aux.resize(std::size_t(batches()) * width * std::size_t(aux_fields));
  pools_.aux.zero();
}

template <int D, class T>
bool DeviceParticles<D, T>::bin(const std::array<std::int32_t, D>& wrap) {
  const std::size_t lanes = std::size_t(batches()) * width;
  if (lanes == 0) return false;
  sort_keys_.resize(lanes);
  order_.resize(lanes);
  run_keys_.resize(lanes);
  run_lengths_.resize(lanes);
  kernels_.find_homes(data(), blocks(), wrap.data(), sort_keys_.data(), order_.data());
  device_.sort(sort_keys_.data(), order_.data(), std::int64_t(lanes));
  const std::int64_t runs = device_.find_runs(sort_keys_.data(), std::int64_t(lanes),
                                              run_keys_.data(), run_lengths_.data());
  run_keys_.resize(std::size_t(runs));
  run_lengths_.resize(std::size_t(runs));
  std::vector<std::uint64_t> keys;
  std::vector<std::int32_t> counts;
  run_keys_.download(keys);
  run_lengths_.download(counts);
  if (!keys.empty() && keys.back() == no_key) {  // padding and the dead
    keys.pop_back();
    counts.pop_back();
  }
  const bool changed = keys != keys_;
  set_blocks(std::move(keys), std::move(counts));
  std::vector<std::int32_t> first{0};
  for (const std::int32_t count : counts_) first.push_back(first.back() + count);
  first_.upload(first);
  resize(spare_, batches());
  kernels_.move(view(pools_), view(spare_), blocks(), order_.data(), first_.data(),
                counts_there_.data(), batch_begin_there_.data());
  std::swap(pools_, spare_);
  return changed;
}

template <int D, class T>
void DeviceParticles<D, T>::find_grid_blocks(const Topology<D>& topology) {
  std::vector<std::int32_t> found;
  for (const std::uint64_t key : keys_) found.push_back(topology.find(key));
  grid_block_.upload(found);
}

template <int D, class T>
std::uint64_t DeviceParticles<D, T>::key_of(std::int32_t lane) const {
  const auto after = std::upper_bound(batch_begin_.begin(), batch_begin_.end(), lane / width);
  return keys_[std::size_t(after - batch_begin_.begin()) - 1];
}

template <int D, class T>
PassData<D, T> DeviceParticles<D, T>::data() const {
  PassData<D, T> data;
  data.fields = fields_;
  data.particles = pools_.particles.data();
  data.aux = pools_.aux.data();
  data.ids = pools_.ids.data();
  data.batch_begin = batch_begin_there_.data();
  data.counts = counts_there_.data();
  data.grid_block = grid_block_.data();
  data.coords = coords_.data();
  data.results = results_.data();
  return data;
}

template <int D, class T>
std::int64_t DeviceParticles<D, T>::bytes() const {
  std::size_t total = 0;
  for (const Pools* pools : {&pools_, &spare_}) {
    total += pools->particles.bytes() + pools->aux.bytes() + pools->ids.bytes();
  }
  total += sort_keys_.bytes() + order_.bytes() + run_keys_.bytes() + run_lengths_.bytes();
  total += counts_there_.bytes() + batch_begin_there_.bytes() + coords_.bytes() +
           grid_block_.bytes() + first_.bytes() + results_.bytes();
  return std::int64_t(total);
}

template <int D, class T>
std::int64_t DeviceParticles<D, T>::needed_bytes(std::int64_t particles, std::int64_t blocks,
                                                 int fields, int aux_fields) {
  const std::int64_t lanes =
      particles + blocks * width / 2;  // the last batch of a block is half full
  const std::int64_t of_lane = 2 * (std::int64_t(sizeof(T)) * (fields + aux_fields) + 8);
  constexpr std::int64_t of_sort =
      3 * (8 + 4);  // keys and lanes, runs of keys, the sort's own copy
  return lanes * (of_lane + of_sort) + blocks * std::int64_t(sizeof(BlockResult<T>) + 4 * (4 + D));
}

template class DeviceParticles<2, float>;
template class DeviceParticles<2, double>;
template class DeviceParticles<3, float>;
template class DeviceParticles<3, double>;

}  // namespace scree
