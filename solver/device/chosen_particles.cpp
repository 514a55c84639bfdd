// SPDX-License-Identifier: Apache-2.0
#include "solver/device/chosen_particles.hpp"

namespace scree {

template <int D, class T>
ChosenParticles<D, T>::ChosenParticles(Device& device, DeviceKernels<D, T>& kernels,
                                       const std::vector<std::int64_t>& ids)
    : kernels_(kernels),
      ids_(ids),
      corner_(ids.size()),
      ids_there_(device, "loads"),
      lane_there_(device, "loads"),
      rows_there_(device, "loads") {
  ids_there_.upload(ids_);
  rows_there_.resize(ids_.size() * row_values);
}

template <int D, class T>
ChosenRows<T> ChosenParticles<D, T>::rows() const {
  return {ids_there_.data(), lane_there_.data(), rows_there_.data(), std::int32_t(ids_.size())};
}

template <int D, class T>
void ChosenParticles<D, T>::find(const DeviceParticles<D, T>& particles) {
  lane_there_.upload(std::vector<std::int32_t>(ids_.size(), -1));
  kernels_.find_chosen(particles.data(), particles.blocks(), rows());
  lane_there_.download(lane_);
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (lane_[k] < 0) continue;
    const BlockCoord<D> block = block_coord<D>(particles.key_of(lane_[k]));
    for (std::size_t a = 0; a < D; ++a) corner_[k][a] = double(block_cells) * block[a];
  }
}

template <int D, class T>
void ChosenParticles<D, T>::read(const PassData<D, T>& data, int body,
                                 std::vector<LoadedParticle<D>>& out) {
  rows_there_.resize(ids_.size() * row_values);
  kernels_.read_chosen(data, rows());
  rows_there_.download(values_);
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (lane_[k] < 0) continue;
    LoadedParticle<D> p;
    p.id = ids_[k];
    p.body = body;
    const T* value = values_.data() + k * row_values;
    for (std::size_t a = 0; a < D; ++a) p.cells[a] = corner_[k][a] + double(*value++);
    for (double& v : p.velocity) v = double(*value++);
    for (double& v : p.increment) v = double(*value++);
    for (double& v : p.acceleration) v = double(*value++);
    out.push_back(p);
  }
}

template <int D, class T>
const LoadedParticle<D>* ChosenParticles<D, T>::write(const PassData<D, T>& data,
                                                      const LoadedParticle<D>* from) {
  values_.assign(ids_.size() * D, T(0));
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (lane_[k] < 0) continue;
    for (std::size_t a = 0; a < D; ++a) values_[k * D + a] = T(from->acceleration[a]);
    ++from;
  }
  rows_there_.upload(values_);
  kernels_.write_chosen(data, rows());
  return from;
}

template <int D, class T>
std::int64_t ChosenParticles<D, T>::bytes() const {
  return std::int64_t(ids_there_.bytes() + lane_there_.bytes() + rows_there_.bytes());
}

template class ChosenParticles<2, float>;
template class ChosenParticles<2, double>;
template class ChosenParticles<3, float>;
template class ChosenParticles<3, double>;

}  // namespace scree
