// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "solver/exec/executor.hpp"
#include "solver/simulation/backend.hpp"

namespace scree {

/// The backend of this machine's processor: works on the bodies' stores themselves, with SIMD lanes
/// on the executor's threads. Results are bitwise the same for any number of threads.
template <int D, class T>
class CpuBackend final : public Backend<D, T> {
 public:
  using typename Backend<D, T>::Bodies;
  using typename Backend<D, T>::Parameters;

  /// Both references must outlive the backend.
  CpuBackend(const BackendConfig<D>& config, const AuxLayout& layout, Bodies& bodies,
             Executor& executor);

  void take_particles() override { refresh_blocks(); }
  void give_particles() override {}
  void take_aux(int, int) override {}
  void set_layout(const AuxLayout& layout) override;
  std::int64_t count(std::size_t body) const override {
    return bodies_[body].body->store().count();
  }
  void bin(const std::array<std::int32_t, D>& wrap) override;
  void p2g(const Parameters& parameters) override;
  void update_grid(const GridForces& forces, std::vector<Collider>& colliders) override;
  void g2p(const Parameters& parameters) override;
  void average_volumes(const Parameters& parameters) override;
  void stress(const Parameters& parameters) override;
  void set_stride(const StrideStep<T>& step) override { stride_ = step; }
  void g2p2g(const Parameters& parameters) override;
  PassReport<D> report() override;
  const std::vector<Reaction>& reactions() const override { return grid_update_.reactions(); }
  const Grid<D, T>& grid() const override { return grid_; }
  const AlignedVector<T>& velocities() override { return config_.fused ? next_ : current_; }
  const AlignedVector<T>& momenta() override { return current_; }
  void set_momenta(const std::vector<T>& values) override;
  UpdatedGrid<D, T> updated_grid() override { return {&current_, &extra_, &grid_update_}; }
  std::int64_t grid_bytes() const override;
  std::int64_t other_bytes() const override;

 private:
  /// What the passes over a body need besides its particles.
  struct Blocks {
    std::vector<std::int32_t> grid_block;                        ///< body block -> topology block
    std::vector<std::int32_t> coords;                            ///< D per body block
    std::vector<BlockResult<T>> results;                         ///< one per body block
    std::array<std::vector<std::int32_t>, power(2, D)> colours;  ///< body blocks of one parity each
    std::vector<std::int32_t> all;
  };

  void refresh_blocks();
  PassData<D, T> pass_data(std::size_t body, const PassParameters<T>& parameters);
  void add_block(const BlockResult<T>& result, int body, std::size_t block,
                 PassReport<D>& report) const;
  BlockCoord<D> coord(std::size_t body, std::size_t block) const;

  BackendConfig<D> config_;
  AuxLayout layout_;
  Bodies& bodies_;
  Executor& executor_;
  Grid<D, T> grid_;
  GridUpdate<D, T> grid_update_;
  AlignedVector<T> current_;     ///< momenta, after update_grid() velocities
  AlignedVector<T> next_;        ///< fused: the grid scattered to
  AlignedVector<T> extra_;       ///< channel 1: impulses, then velocity changes
  AlignedVector<T> volumes_[2];  ///< average_volumes(): sums, then means of its two channels
  std::vector<Blocks> blocks_;
  StrideStep<T> stride_;
  double grid_mass_ = 0;
};

extern template class CpuBackend<2, float>;
extern template class CpuBackend<2, double>;
extern template class CpuBackend<3, float>;
extern template class CpuBackend<3, double>;

}  // namespace scree
