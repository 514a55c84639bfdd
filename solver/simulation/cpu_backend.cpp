// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/cpu_backend.hpp"

#include <algorithm>

#include "solver/grid/node_means.hpp"
#include "solver/step/split_passes.hpp"
#include "solver/step/volume_passes.hpp"

namespace scree {

template <int D, class T>
CpuBackend<D, T>::CpuBackend(const BackendConfig<D>& config, const AuxLayout& layout,
                             Bodies& bodies, Executor& executor)
    : config_(config),
      layout_(layout),
      bodies_(bodies),
      executor_(executor),
      grid_(config.domain.lattices),
      grid_update_(config.domain, config.faces, config.lower, config.cell_size) {}

template <int D, class T>
void CpuBackend<D, T>::set_layout(const AuxLayout& layout) {
  if (layout.total != layout_.total) {
    for (BodyState<D, T>& state : bodies_) state.body->store().resize_aux(layout.total);
  }
  layout_ = layout;
}

template <int D, class T>
void CpuBackend<D, T>::bin(const std::array<std::int32_t, D>& wrap) {
  bool changed = false;
  for (BodyState<D, T>& state : bodies_)
    changed |= state.body->store().rebin(wrap, executor_.pool());
  if (changed) {
    const Topology<D> before = grid_.topology();
    // A particle that is moved to the other side takes along the blocks beyond the face.
    if (config_.fused) grid_update_.fold_periodic(current_);
    refresh_blocks();
    if (config_.fused) {
      grid_.carry_over(before, current_, next_, executor_.pool());
      std::swap(current_, next_);
    }
  } else {
    for (Blocks& blocks : blocks_) blocks.results.assign(blocks.results.size(), BlockResult<T>{});
  }
}

/// Rebuilds what hangs on the set of blocks.
template <int D, class T>
void CpuBackend<D, T>::refresh_blocks() {
  std::vector<std::uint64_t> occupied;
  for (const BodyState<D, T>& state : bodies_) {
    for (const auto& block : state.body->store().blocks()) occupied.push_back(block.key);
  }
  std::sort(occupied.begin(), occupied.end());
  occupied.erase(std::unique(occupied.begin(), occupied.end()), occupied.end());
  grid_.topology().build(occupied, config_.domain);
  grid_update_.rebuild(grid_);
  blocks_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto& of_body = bodies_[i].body->store().blocks();
    Blocks& blocks = blocks_[i];
    blocks.grid_block.clear();
    blocks.coords.clear();
    blocks.all.clear();
    for (auto& colour : blocks.colours) colour.clear();
    for (std::size_t b = 0; b < of_body.size(); ++b) {
      const BlockCoord<D> c = block_coord<D>(of_body[b].key);
      std::size_t colour = 0;
      for (int a = 0; a < D; ++a) {
        blocks.coords.push_back(c[a]);
        colour = 2 * colour + std::size_t(c[a] & 1);
      }
      blocks.grid_block.push_back(grid_.topology().find(of_body[b].key));
      blocks.colours[colour].push_back(std::int32_t(b));
      blocks.all.push_back(std::int32_t(b));
    }
    blocks.results.assign(of_body.size(), BlockResult<T>{});
  }
}

template <int D, class T>
PassData<D, T> CpuBackend<D, T>::pass_data(std::size_t body, const PassParameters<T>& parameters) {
  ParticleStore<D, T>& store = bodies_[body].body->store();
  Blocks& blocks = blocks_[body];
  PassData<D, T> data;
  data.parameters = parameters;
  data.layout = layout_;
  data.fields = store.fields();
  data.particles = store.count() > 0 ? store.batch(0) : nullptr;
  data.aux = store.count() > 0 ? store.aux_batch(0) : nullptr;
  data.ids = store.count() > 0 ? store.ids(0) : nullptr;
  data.batch_begin = store.batch_begin().data();
  data.batch_list = store.batch_list().data();
  data.counts = store.counts().data();
  data.grid_block = blocks.grid_block.data();
  data.coords = blocks.coords.data();
  data.neighbours = grid_.topology().neighbour_table().data();
  data.read[0] = current_.data();
  data.read[1] = extra_.data();
  data.write[0] = current_.data();
  data.write[1] = extra_.data();
  data.results = blocks.results.data();
  data.stride = stride_;
  return data;
}

template <int D, class T>
void CpuBackend<D, T>::p2g(const Parameters& parameters) {
  grid_.clear(current_, executor_.pool());
  if (config_.separate_force) grid_.clear(extra_, executor_.pool());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PassData<D, T> data = pass_data(i, parameters[i]);
    for (const auto& colour : blocks_[i].colours) {
      run_p2g(config_.kernel, config_.transfer, executor_, data, colour);
    }
  }
}

template <int D, class T>
void CpuBackend<D, T>::update_grid(const GridForces& forces, std::vector<Collider>& colliders) {
  grid_mass_ = grid_update_.apply(grid_, current_, extra_, forces, colliders, executor_.pool());
}

template <int D, class T>
void CpuBackend<D, T>::g2p(const Parameters& parameters) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PassData<D, T> data = pass_data(i, parameters[i]);
    run_g2p(config_.kernel, config_.transfer, executor_, data, blocks_[i].all);
  }
}

/// Each body by itself: a soft one beside a stiff one keeps its own changes of volume.
template <int D, class T>
void CpuBackend<D, T>::average_volumes(const Parameters& parameters) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PassData<D, T> data = pass_data(i, parameters[i]);
    for (int c = 0; c < volume_channels<D>; ++c) {
      grid_.clear(volumes_[c], executor_.pool());
      data.read[c] = data.write[c] = volumes_[c].data();
    }
    const VolumeFields fields = volume_fields(*bodies_[i].body, config_.volume_ratio);
    for (const auto& colour : blocks_[i].colours) {
      run_volume_scatter(config_.kernel, executor_, data, fields, colour);
    }
    for (int c = 0; c < volume_channels<D>; ++c) {
      form_node_means(grid_, grid_update_.pairs(), volumes_[c], executor_.pool());
    }
    run_volume_gather(config_.kernel, executor_, data, fields, blocks_[i].all);
  }
}

template <int D, class T>
void CpuBackend<D, T>::stress(const Parameters& parameters) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].body->stress(executor_, pass_data(i, parameters[i]), blocks_[i].all);
  }
}

template <int D, class T>
void CpuBackend<D, T>::g2p2g(const Parameters& parameters) {
  grid_.clear(next_, executor_.pool());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PassData<D, T> data = pass_data(i, parameters[i]);
    data.write[0] = next_.data();
    for (const auto& colour : blocks_[i].colours) {
      bodies_[i].body->g2p2g(executor_, data, colour, config_.kernel);
    }
  }
  std::swap(current_, next_);
}

template <int D, class T>
BlockCoord<D> CpuBackend<D, T>::coord(std::size_t body, std::size_t block) const {
  BlockCoord<D> c{};
  for (int a = 0; a < D; ++a) c[a] = blocks_[body].coords[block * D + std::size_t(a)];
  return c;
}

template <int D, class T>
void CpuBackend<D, T>::add_block(const BlockResult<T>& result, int body, std::size_t block,
                                 PassReport<D>& report) const {
  const auto raise = [&](double& most, double value, BlockPlace<D>& place) {
    if (!(value > most)) return;
    most = value;
    place = {body, coord(std::size_t(body), block)};
  };
  raise(report.max_speed, double(result.max_speed), report.fastest);
  raise(report.max_signal, double(result.max_signal), report.stiffest);
  report.max_excursion = std::max(report.max_excursion, double(result.max_excursion));
  report.dead[std::size_t(body)] += result.dead;
  if (result.fault == FaultCode::none || report.fault.code != FaultCode::none) return;
  auto& fault = report.fault;
  fault = {result.fault,
           body,
           coord(std::size_t(body), block),
           result.fault_id,
           double(result.fault_value),
           {}};
  for (int a = 0; a < D; ++a) fault.position[std::size_t(a)] = double(result.fault_position[a]);
}

template <int D, class T>
PassReport<D> CpuBackend<D, T>::report() {
  PassReport<D> report;
  report.grid_mass = grid_mass_;
  report.dead.assign(bodies_.size(), 0);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    for (std::size_t b = 0; b < blocks_[i].results.size(); ++b) {
      add_block(blocks_[i].results[b], int(i), b, report);
    }
  }
  return report;
}

template <int D, class T>
void CpuBackend<D, T>::set_momenta(const std::vector<T>& values) {
  current_.assign(values.begin(), values.end());
}

template <int D, class T>
std::int64_t CpuBackend<D, T>::grid_bytes() const {
  const std::size_t values = current_.capacity() + next_.capacity() + extra_.capacity() +
                             volumes_[0].capacity() + volumes_[1].capacity();
  return std::int64_t(values * sizeof(T)) +
         std::int64_t(grid_.topology().size()) * (8 + 4 * neighbour_count<D>);
}

template <int D, class T>
std::int64_t CpuBackend<D, T>::other_bytes() const {
  std::int64_t total = executor_.bytes();
  for (const Blocks& blocks : blocks_) {
    total += std::int64_t(blocks.results.capacity() * sizeof(BlockResult<T>));
  }
  return total;
}

template class CpuBackend<2, float>;
template class CpuBackend<2, double>;
template class CpuBackend<3, float>;
template class CpuBackend<3, double>;

}  // namespace scree
