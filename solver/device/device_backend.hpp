// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "solver/device/chosen_particles.hpp"
#include "solver/device/device_grid.hpp"
#include "solver/device/device_particles.hpp"
#include "solver/device/toolkit.hpp"
#include "solver/simulation/backend.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// The backend of a device. Particles and grid stay there; a step asks it for work and waits once
/// for a few numbers (twice where the path is split). The bodies' stores are a copy for output.
template <int D, class T>
class DeviceBackend final : public Backend<D, T> {
 public:
  using typename Backend<D, T>::Bodies;
  using typename Backend<D, T>::Parameters;

  /// setups: those of the bodies, for their laws. bodies, pool and toolkit must outlive the
  /// backend.
  DeviceBackend(const BackendConfig<D>& config, const AuxLayout& layout, Bodies& bodies,
                ThreadPool& pool, const DeviceToolkit& toolkit,
                const std::vector<BodySetup>& setups);

  void take_particles() override;
  void give_particles() override;
  void take_aux(int first, int count) override;
  bool load_only(const std::vector<std::int64_t>& ids) override;
  std::vector<LoadedParticle<D>>& read_loaded() override;
  void write_loaded() override;
  void set_layout(const AuxLayout& layout) override;
  std::int64_t count(std::size_t body) const override { return particles_[body].count(); }
  void bin(const std::array<std::int32_t, D>& wrap) override;
  void p2g(const Parameters& parameters) override;
  void update_grid(const GridForces& forces, std::vector<Collider>& colliders) override;
  void g2p(const Parameters& parameters) override;
  void stress(const Parameters& parameters) override;
  void g2p2g(const Parameters& parameters) override;
  PassReport<D> report() override;
  const std::vector<Reaction>& reactions() const override { return reactions_; }
  const Grid<D, T>& grid() const override { return grid_.blocks(); }
  const AlignedVector<T>& velocities() override;
  const AlignedVector<T>& momenta() override;
  void set_momenta(const std::vector<T>& values) override;
  std::int64_t grid_bytes() const override { return grid_.bytes(); }
  std::int64_t other_bytes() const override;

 private:
  MemoryNeed memory_need() const;
  void check_memory() const;
  void find_blocks(bool carry);
  void find_loaded();
  void p2g_fixed(const Parameters& parameters);
  PassData<D, T> pass_data(std::size_t body, const PassParameters<T>& parameters) const;
  /// Where the numbers that a step reads back lie: mass, reactions, summaries.
  double* mass_there() const;
  double* reactions_there() const { return mass_there() + 1; }
  void resize_read_back(std::size_t colliders);
  void read_reactions(const double* values);
  void add_summary(const BodySummary<T>& summary, int body, PassReport<D>& report) const;

  BackendConfig<D> config_;
  AuxLayout layout_;
  Bodies& bodies_;
  ThreadPool& pool_;
  const DeviceToolkit& toolkit_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<DeviceKernels<D, T>> kernels_;
  std::vector<std::unique_ptr<DeviceLaw<D, T>>> laws_;
  std::vector<DeviceParticles<D, T>> particles_;
  std::vector<ChosenParticles<D, T>> chosen_;  ///< one a body; none without load_only()
  std::vector<LoadedParticle<D>> loaded_;
  DeviceGrid<D, T> grid_;
  DeviceArray<unsigned char> read_back_;  ///< summaries of the bodies, mass, reactions
  std::size_t colliders_ = 0;
  bool stores_are_old_ = false;
  bool updated_ = false;      ///< the grid was updated since the last report
  double update_dt_ = 0;      ///< [s]
  AlignedVector<T> channel_;  ///< copy of a channel, for output
  std::vector<Reaction> reactions_;
};

extern template class DeviceBackend<2, float>;
extern template class DeviceBackend<2, double>;
extern template class DeviceBackend<3, float>;
extern template class DeviceBackend<3, double>;

}  // namespace scree
