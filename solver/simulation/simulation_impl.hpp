// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "solver/simulation/backend.hpp"
#include "solver/simulation/external_force.hpp"
#include "solver/simulation/particle_view.hpp"
#include "solver/simulation/simulation.hpp"
#include "solver/simulation/simulation_on_device.hpp"
#include "solver/simulation/step_clock.hpp"
#include "solver/simulation/stride.hpp"
#include "solver/step/body.hpp"
#include "solver/step/volume_fields.hpp"

namespace scree {

struct FieldSource;
class MaterialPoint;
template <int D>
class CoupledFlow;
template <int D>
struct FlowChunk;
template <int D>
struct FlowVector;
template <int D>
struct FlowPoints;

enum class Phase { binning, grid, particles, stress, external, pressure, count };

/// The simulation in D dimensions with reals T.
template <int D, class T>
class SimulationImpl final : public Simulation {
 public:
  /// device: where to compute; null: this machine's processor.
  SimulationImpl(SimulationSetup setup, std::shared_ptr<const DeviceToolkit> device);
  ~SimulationImpl() override;

  void step() override;
  double time() const override { return clock_.time; }
  double dt() const override { return clock_.dt; }
  double next_time() const override { return clock_.next_time; }
  std::int64_t step_count() const override { return step_; }
  std::int64_t particle_count() const override;
  std::int64_t removed_count() const override { return removed_; }
  bool fused() const override { return fused_; }
  bool coupled() const override { return flow_ != nullptr; }
  bool loaded() const override { return external_ != nullptr; }
  StepLimit step_limit() const override;
  HistoryRow history() const override;
  using Simulation::particles;
  ParticleSnapshot particles(const std::vector<std::string>& fields,
                             const ParticleFilter& filter) const override;
  std::vector<GridSnapshot> grid() const override;
  void save(StateWriter& writer) const override;
  void load(const StateReader& reader) override;
  std::int64_t block_count() const override { return backend_->grid().topology().size(); }
  MemoryReport memory() const override;
  PhaseTimes phases() const override;
  StepTraffic traffic() const override;

 private:
  using State = BodyState<D, T>;
  using Parameters = std::vector<PassParameters<T>>;

  // simulation_setup.cpp
  void check_path() const;
  GridDomain<D> make_domain() const;
  Faces<D> make_faces() const;
  AuxLayout make_layout(bool motion) const;
  StrideFields stride_fields(const AuxLayout& layout) const;
  bool averages() const { return setup_.volumetric_locking == VolumetricLocking::fbar; }
  int volume_ratio_field() const { return averages() ? layout_.total - volume_aux_fields : -1; }
  void start_volume_ratios(State& state);
  std::unique_ptr<Backend<D, T>> make_backend();
  void add_body(const BodySetup& setup, std::int32_t index);
  void place_particles(const BodySetup& setup, State& state);
  void set_motion(const BodySetup& setup, std::size_t p, const std::array<double, 3>& local,
                  std::int64_t slot, ParticleStore<D, T>& store);
  void first_step();

  // simulation_step.cpp
  void step_fused();
  void step_split();
  void bin_if_needed();
  std::array<double, 3> gravity_of(double begin, double dt) const;
  GridForces grid_forces() const;
  void update_grid();
  void scatter_all(double dt);
  void average_volumes(const Parameters& pass);
  void update_external();
  void update_loads_alone();
  void update_loads();
  void weigh_gained_water();
  template <class F>
  void each_gain(F&& f);
  void add_gained_weight(const std::array<double, 3>& gravity);
  double external_power() const;
  double external_work(double power_at_end) const;
  void note_collider_work();
  void finish_step();
  PassParameters<T> pass_parameters(const State& state, double dt, double dt_next) const;
  Parameters parameters(double dt, double dt_next) const;
  StrideStep<T> stride_step(double dt_next) const;
  void read_motion(const PassReport<D>& report);
  void read_signals(const PassReport<D>& report);
  void check_fault(const typename PassReport<D>::Fault& found) const;
  void check_mass(double grid_mass) const;
  void check_count() const;
  void time_phase(Phase phase, std::chrono::steady_clock::time_point start) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    seconds_[std::size_t(phase)] += spent.count();
  }

  // simulation_coupling.cpp
  void make_flow();
  void start_flow();
  void order_flow();
  void note_masses();
  void collect_flow();
  bool couple_flow(int halvings);
  bool strides() const { return stride_fields_.growth >= 0; }
  void lend_velocities(AlignedVector<T>& nodes);
  double take_velocities();
  template <class F>
  void each_node(F&& f) const;
  void halve_step();
  using FlowBlock = typename ParticleStore<D, T>::Block;
  std::vector<const FlowBlock*> list_flow_chunks();
  void collect_flow_points(bool follow);
  void load_positions(const ParticleStore<D, T>& store, const FlowBlock& block,
                      FlowVector<D>& vector) const;
  static void widen(const T* from, double* to);
  static void fetch(const T* pool, int first, int fields);
  void order_chunk(FlowChunk<D>& chunk, const FlowBlock& block);
  void fill_chunk(const FlowChunk<D>& chunk, const FlowBlock& block, bool follow,
                  FlowPoints<D>& points);
  void load_changes(const ParticleStore<D, T>& store, const FlowBlock& block,
                    FlowVector<D>& vector) const;
  void set_moments(const FlowChunk<D>& chunk, FlowPoints<D>& points) const;

  // simulation_state.cpp
  void save_stride(StateWriter& writer) const;
  void load_stride(const StateReader& reader);

  // simulation_clock.cpp
  double stable_dt() const;
  PlannedStep plan_first();
  PlannedStep plan(double t, std::int64_t step);

  // simulation_output.cpp
  template <class F>
  void visit_block(const State& state, std::size_t number, F&& f) const;
  void add_flow(const BodyInfo& info, ParticleView& view) const;
  void require_record(const char* what) const;
  std::array<double, 3> position_of(std::uint64_t key, const ParticleStore<D, T>& store,
                                    std::int32_t batch, int lane) const;
  void write_row(const ParticleView& particle, const State& state,
                 const std::vector<FieldSource>& sources, std::size_t row,
                 std::unique_ptr<MaterialPoint>& point, ParticleSnapshot& out) const;
  std::vector<std::int64_t> choose(const ParticleFilter& filter) const;
  double yield_distance(const ParticleView& particle, const State& state,
                        std::unique_ptr<MaterialPoint>& point) const;
  void write_strain_rate(const ParticleView& particle, const State& state, double* out) const;
  void fill_lattice(const GridSnapshot& snapshot, int lattice, std::vector<double>& mass,
                    std::vector<double>& velocity) const;

  SimulationSetup setup_;
  std::shared_ptr<const DeviceToolkit> device_;
  bool fused_ = true;
  bool separate_ = false;
  AuxLayout layout_;
  StrideFields stride_fields_;  ///< of layout_
  mutable Executor executor_;   ///< its threads also serve const sums
  GridDomain<D> domain_;
  std::vector<State> bodies_;
  std::unique_ptr<Backend<D, T>> backend_;  ///< refers to bodies_ and executor_
  std::vector<Collider> colliders_;
  std::unique_ptr<ExternalForce> external_;
  bool loads_alone_ = false;   ///< the backend brings loaded particles alone
  double external_work_ = 0;   ///< of the loads on particles up to the last step's start [J]
  double external_power_ = 0;  ///< of the same loads at that start [W]
  std::vector<double> collider_work_;     ///< done on the particles since t = 0 [J]
  std::unique_ptr<CoupledFlow<D>> flow_;  ///< pore water, where there is any
  std::vector<double> lent_;              ///< see lend_velocities()
  std::vector<double> reference_;         ///< X by particle id, 3 each [m]
  StepClock clock_;
  PlannedStep planned_{};
  Stride stride_;
  MotionBounds bounds_;
  double first_stable_ = 0;               ///< bound of the step at t = 0 [s]; 0: none
  double stable_ = 0;                     ///< bound of the coming step [s]
  BlockPlace<D> fastest_{}, stiffest_{};  ///< where max_speed and max_signal are
  std::int64_t step_ = 0;
  std::int64_t removed_ = 0;
  std::int64_t initial_count_ = 0;
  std::int64_t pending_dead_ = 0;  ///< particles marked dead that the next binning drops
  bool recorded_ = true;           ///< aux fields hold the state at time()
  double scattered_mass_ = 0;
  std::array<double, std::size_t(Phase::count)> seconds_{};
};

extern template class SimulationImpl<2, float>;
extern template class SimulationImpl<2, double>;
extern template class SimulationImpl<3, float>;
extern template class SimulationImpl<3, double>;

}  // namespace scree
