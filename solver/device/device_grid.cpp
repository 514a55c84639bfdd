// SPDX-License-Identifier: Apache-2.0
#include "solver/device/device_grid.hpp"

#include <algorithm>
#include <utility>

namespace scree {

template <int D, class T>
DeviceGrid<D, T>::DeviceGrid(Device& device, DeviceKernels<D, T>& kernels,
                             const BackendConfig<D>& config)
    : current(device, "the grid"),
      next(device, "the grid"),
      extra(device, "the grid"),
      device_(device),
      kernels_(kernels),
      config_(config),
      grid_(config.domain.lattices),
      contacts_(device, config.lower, config.cell_size),
      overflow_(device, "the grid"),
      neighbours_(device, "the grid"),
      from_block_(device, "the grid"),
      block_mass_(device, "the grid") {
  for (int a = 0; a < D; ++a) faces_.emplace_back(device);
  if (!config.deterministic) return;
  for (int i = 0; i < (config.separate_force ? 2 : 1); ++i) fixed_.emplace_back(device, "the grid");
}

template <int D, class T>
void DeviceGrid<D, T>::rebuild(const std::vector<std::uint64_t>& occupied, bool carry) {
  const Topology<D> before = grid_.topology();
  if (carry) {
    // A particle that is moved to the other side takes along the blocks beyond the face.
    for (int axis = 0; axis < D; ++axis) {
      if (faces_[std::size_t(axis)].empty()) continue;
      kernels_.fold_periodic(lines(axis), current.data());
    }
  }
  grid_.topology().build(occupied, config_.domain);
  neighbours_.upload(grid_.topology().neighbour_table());
  const FacePairs<D> pairs = find_face_pairs(grid_, config_.domain);
  for (int axis = 0; axis < D; ++axis) {
    faces_[std::size_t(axis)].build(grid_, pairs[std::size_t(axis)], axis);
  }
  contacts_.forget();
  if (carry) carry_over(before);
}

template <int D, class T>
void DeviceGrid<D, T>::carry_over(const Topology<D>& before) {
  std::vector<std::int32_t> from;
  for (const std::uint64_t key : grid_.topology().keys()) from.push_back(before.find(key));
  from_block_.upload(from);
  next.resize(grid_.size());
  kernels_.carry_over(from_block_.data(), grid_.topology().size(), int(grid_.block_values()),
                      current.data(), next.data());
  std::swap(current, next);
}

template <int D, class T>
void DeviceGrid<D, T>::clear(DeviceArray<T>& channel) {
  channel.resize(grid_.size());
  channel.zero();
}

template <int D, class T>
FixedChannels DeviceGrid<D, T>::fixed_sums(double m, double v) {
  FixedChannels sums;
  sums.set_units(m, v);
  for (std::size_t i = 0; i < fixed_.size(); ++i) {
    fixed_[i].resize(grid_.size());
    fixed_[i].zero();
    sums.sum[i] = fixed_[i].data();
  }
  overflow_.resize(1);
  overflow_.zero();
  sums.overflow = overflow_.data();
  return sums;
}

template <int D, class T>
void DeviceGrid<D, T>::take(const FixedChannels& sums) {
  const auto values = std::int64_t(grid_.size());
  for (int i = 0; i < int(fixed_.size()); ++i) {
    DeviceArray<T>& channel = i == 0 ? current : extra;
    channel.resize(grid_.size());
    kernels_.from_fixed(sums, i, values, channel.data());
  }
}

template <int D, class T>
NodePass<T> DeviceGrid<D, T>::node_pass(const GridForces& forces) const {
  NodePass<T> pass;
  pass.p = current.data();
  pass.q = forces.separate_force ? extra.data() : nullptr;
  pass.blocks = grid_.topology().size();
  pass.block_nodes = grid_.lattices() * block_node_count<D>;
  for (int a = 0; a < D; ++a) pass.kick[a] = T(forces.dt * forces.gravity[std::size_t(a)]);
  pass.keep = T(forces.kept());
  pass.local = T(forces.opposed());
  return pass;
}

template <int D, class T>
FoldLines DeviceGrid<D, T>::lines(int axis) const {
  FoldLines lines = faces_[std::size_t(axis)].view();
  lines.axis = axis;
  for (std::size_t side = 0; side < 2; ++side) {
    lines.type[side] = config_.faces.type[std::size_t(axis)][side];
    lines.friction[side] = config_.faces.friction[std::size_t(axis)][side];
  }
  lines.no_slip = config_.faces.no_slip;
  return lines;
}

/// Whether a face of the axis folds in this stage.
template <int D, class T>
bool DeviceGrid<D, T>::folds(int axis, int stage) const {
  if (faces_[std::size_t(axis)].empty()) return false;
  const auto& types = config_.faces.type[std::size_t(axis)];
  return std::any_of(types.begin(), types.end(), [&](FaceType type) {
    return type != FaceType::open && fold_stage(type, config_.faces.no_slip) == stage;
  });
}

template <int D, class T>
void DeviceGrid<D, T>::fold(T* p, T* before) {
  for (int stage = 0; stage < fold_stages; ++stage) {
    for (int axis = 0; axis < D; ++axis) {
      if (folds(axis, stage)) kernels_.fold(lines(axis), stage, p, before);
    }
  }
}

template <int D, class T>
void DeviceGrid<D, T>::unfold(T* p, T* q) {
  for (int stage = fold_stages - 1; stage >= 0; --stage) {
    for (int axis = D - 1; axis >= 0; --axis) {
      if (folds(axis, stage)) kernels_.unfold(lines(axis), stage, p, q);
    }
  }
}

template <int D, class T>
void DeviceGrid<D, T>::update(const GridForces& forces, const std::vector<Collider>& colliders,
                              ThreadPool& pool, double* mass, double* reactions) {
  const NodePass<T> pass = node_pass(forces);
  block_mass_.resize(std::size_t(pass.blocks));
  kernels_.add_forces(pass, grid_.lattices(), block_mass_.data(), mass);
  fold(pass.p, pass.q);
  kernels_.divide(pass);
  ContactNodes nodes;
  if (!colliders.empty()) {
    contacts_.update(grid_, colliders, pool);
    nodes = contacts_.nodes();
    kernels_.touch(nodes, contacts_.surfaces(), pass);
    kernels_.react(contacts_.sums(), contacts_.surfaces(), nodes.impulse, reactions);
  }
  if (pass.local > T(0)) kernels_.damp(pass, nodes);
  if (pass.q != nullptr) kernels_.subtract(pass);
  unfold(pass.p, pass.q);
}

template <int D, class T>
std::int64_t DeviceGrid<D, T>::bytes() const {
  std::int64_t total = contacts_.bytes();
  for (const FaceLines& faces : faces_) total += faces.bytes();
  for (const auto& sums : fixed_) total += std::int64_t(sums.bytes());
  return total + std::int64_t(current.bytes() + next.bytes() + extra.bytes() + neighbours_.bytes() +
                              from_block_.bytes() + block_mass_.bytes());
}

template <int D, class T>
std::int64_t DeviceGrid<D, T>::needed_bytes(const std::vector<std::uint64_t>& occupied) const {
  Topology<D> topology;
  topology.build(occupied, config_.domain);
  const int channels = config_.fused || config_.separate_force ? 2 : 1;
  const std::size_t of_value =
      std::size_t(channels) * sizeof(T) + fixed_.size() * sizeof(FixedChannels::Value);
  const auto of_block = std::int64_t(grid_.block_values() * of_value +
                                     neighbour_count<D> * sizeof(std::int32_t) + sizeof(double));
  return std::int64_t(topology.size()) * of_block;
}

template class DeviceGrid<2, float>;
template class DeviceGrid<2, double>;
template class DeviceGrid<3, float>;
template class DeviceGrid<3, double>;

}  // namespace scree
