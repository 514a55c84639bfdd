// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/coupling/coupling_setup.hpp"
#include "solver/coupling/drained_surface.hpp"
#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/missed_volume.hpp"
#include "solver/coupling/node_constraints.hpp"
#include "solver/coupling/point_order.hpp"
#include "solver/coupling/pore_cells.hpp"
#include "solver/coupling/pore_states.hpp"
#include "solver/coupling/pressure_matrix.hpp"
#include "solver/coupling/pressure_product.hpp"
#include "solver/coupling/pressure_solver.hpp"
#include "solver/coupling/volume_operator.hpp"
#include "solver/grid/grid_update.hpp"
#include "solver/io/snapshot.hpp"
#include "solver/io/state_archive.hpp"

namespace scree {

/// A body as the water sees it.
struct FlowBody {
  std::optional<PoreSetup> pores;  ///< nothing: no water
  double particle_volume = 0;      ///< V0 [m^3] (2D: m^2)
  std::int64_t first_id = 0;
};

/// The frame of the computation.
template <int D>
struct FlowDomain {
  KernelType kernel = KernelType::compact;
  TransferType transfer = TransferType::mls;
  std::array<std::int32_t, D> cells{};
  std::array<bool, D> periodic{};
  typename PressureLattice<D>::Walls walls{};
  /// Laws see other increments than the particles move by (volumetric_locking): note_increment().
  bool own_increments = false;
  int stride = 1;                 ///< most steps with the same points
  std::array<double, 3> lower{};  ///< [m]
  double cell_size = 1;           ///< [m]
};

/// A vector of particles of a chunk, in the order of the block.
template <int D>
struct FlowVector {
  static constexpr int width = PoreStates<D>::width;
  alignas(64) double position[D][width];       ///< cells from the block's lower corner
  alignas(64) double increment[D * D][width];  ///< dt grad v since the last points
  alignas(64) double growth[width];            ///< relative change of volume since then
  std::int64_t place = 0;                      ///< in PoreStates, of the first lane
  int first = 0;                               ///< number of the first one in the block
  int count = 0;                               ///< the others are padding: finite numbers
};

/// The growth that follows from the increment.
template <int D>
void set_growth(FlowVector<D>& particles);

/// What a step gives to the pressure solve.
template <int D>
struct FlowStep {
  double dt = 0;                    ///< [s]
  double end = 0;                   ///< time after the step [s]
  std::array<double, 3> gravity{};  ///< [m/s^2]
  double keep = 1;                  ///< share of a node's velocity that mass damping leaves
  GridDecisions<D> decisions;
  const std::vector<Collider>* colliders = nullptr;
  double touch = 0;    ///< see NodeConstraints::find
  bool record = true;  ///< somebody looks at the water of the particles after the step
  /// What a force does to the momentum of its node in the step.
  double impulse() const { return dt * keep; }
  // Of a stride, whose steps share their points:
  bool begins = true;      ///< the points are those of this step
  bool may_go_on = false;  ///< the next step may not have its own
};

/// Pore water, two-way coupled: with velocities v* that hold the effective stress and all other
/// forces, the pressure p of the step's end solves
///
///     (S/dt + H + R + dt/L sum Q^T M^-1 Q) p = S p_0/dt - Q^T v*/L + weight - defect/dt
///
/// (L lattices) and v = v* + dt M^-1 Q p goes on to the particles. The matrix is that of the
/// discrete equations themselves, symmetric and positive definite. Derivation, spectra and limits:
/// docs/coupling.md.
template <int D>
class CoupledFlow {
 public:
  CoupledFlow(CouplingSetup setup, const FlowDomain<D>& domain, std::vector<FlowBody> bodies,
              std::int64_t particles);

  bool has_water(std::int32_t body) const { return bodies_[std::size_t(body)].pores.has_value(); }
  /// Half the side of a particle's box at t = 0 [m].
  double half_side(std::int32_t body) const { return half_side_[std::size_t(body)]; }
  /// Pressure [Pa] and the law's volume ratio of a particle at t = 0.
  void start(std::int64_t id, std::int32_t body, double pressure, double volume_ratio);

  /// Where the particles are; begin_order() and put() of it tell of a new order of the stores.
  PoreStates<D>& states() { return states_; }
  const PoreStates<D>& states() const { return states_; }
  /// Ends a new order. Water of particles that have gone counts as outflow.
  void end_order();

  /// Must be called before the points of a step are set, whose blocks the topology holds.
  void follow(const Topology<D>& topology);

  // A step: masses, points, solve. Points come chunk by chunk: first where they are, then, with the
  // pores of the particles, Q, storage and flow of all chunks.
  NodeConstraints<D>& constraints() { return constraints_; }
  std::vector<FlowChunk<D>>& chunks() { return chunks_; }
  const std::vector<FlowChunk<D>>& chunks() const { return chunks_; }
  PointOrder<D>& order() { return order_; }
  /// The chunks are those of this step; loaded: points may have moments.
  void begin_points(bool loaded);
  /// After order() knows all points. fill(chunk number, points): sets the points of a chunk, on any
  /// thread, by way of fill().
  void assemble(const std::function<void(std::int32_t, FlowPoints<D>&)>& fill, ThreadPool& pool);
  /// Follows the pores of a vector of particles since the last points and sets their points. Once
  /// for all points a particle; any thread.
  void fill(const FlowVector<D>& particles, const FlowChunk<D>& chunk, FlowPoints<D>& points);
  bool keeps_increments() const { return !own_.empty(); }
  /// What the last step did to a particle, D x D; with FlowDomain::own_increments only. Any thread,
  /// one a particle.
  void note_increment(std::int64_t id, const std::array<double, D * D>& increment) {
    own_[std::size_t(id)] = increment;
  }
  const std::array<double, D * D>& increment(std::int64_t id) const {
    return own_[std::size_t(id)];
  }
  /// Velocities of the nodes, set by the caller: v* before solve(), v after it.
  NodeVelocities& velocity() { return velocity_; }
  /// Solves for the pressure. False where the solver does not converge: velocity() is then of no
  /// use, and the step may be tried again with another length for the same points.
  [[nodiscard]] bool solve(const FlowStep<D>& step, const Topology<D>& topology, ThreadPool& pool);
  /// The pressures that were found are those of the step. ends: the next one has its own points.
  void end_step(const FlowStep<D>& step, bool ends, ThreadPool& pool);
  /// Why the last solve failed, after the step has been halved so many times; `end`: of the step.
  std::string failure(double end, int halvings) const;
  int most_halvings() const { return setup_.halvings; }
  void note_halving() { ++halvings_; }
  /// What the pressure adds to the colliders' reactions of the step.
  const std::vector<Reaction>& reactions() const { return reactions_; }

  /// Seconds spent in the parts of solve() since the start.
  std::vector<std::pair<std::string, double>> times() const;

  // Of a particle, at the end of the last step; volume_ratio: the law's.
  double pressure(std::int64_t id) const { return number(id, PoreRow<D>::pressure); }
  std::array<double, 3> seepage(std::int64_t id) const;
  double porosity(std::int32_t body, std::int64_t id, double volume_ratio) const;
  double biot(std::int32_t body) const { return bodies_[std::size_t(body)].pores->biot; }
  /// Mass of the water in a particle's pores [kg].
  double fluid_mass(std::int32_t body, std::int64_t id, double volume_ratio) const;
  /// What the water in the pores of the particles from a place on has gained since t = 0 [kg], as
  /// the last points say.
  Lanes<double> gained_mass(std::int32_t body, std::int64_t place) const;
  /// mass: sum of fluid_mass() over the particles.
  FluidBalance balance(double mass) const;

  /// The nodal pressures of the last step inside and just around the domain, field `pore_pressure`;
  /// NaN where no water is near and before the first step. Time and step are left to the caller.
  GridSnapshot grid() const;

  std::int64_t bytes() const;
  void save(StateWriter& writer) const;
  /// Into the order of the start; the stores' own order comes after it.
  void load(const StateReader& reader);

 private:
  /// Stretch at which a particle's box stops to grow: far beyond, in long flows, F says no more
  /// which part of the soil is the particle's.
  static constexpr double longest_box = 2;

  /// Parts of a solve, for the times.
  enum class Part { points, constraints, matrix, solve, forces, count };
  using Clock = std::chrono::steady_clock;
  void time_part(Part part, Clock::time_point& start);

  Mat3<double> deformation(std::int64_t id) const;
  double largest_half(std::size_t body) const;
  double own_ratio(std::int64_t id, double volume_ratio) const;
  double number(std::int64_t id, int row) const { return states_.at(states_.place(id), row); }
  double stored_volume(std::int64_t id) const;
  template <class Self>
  static auto nodal_fields(Self& self);
  void save_nodes(StateWriter& writer) const;
  bool load_nodes(const StateReader& reader);
  bool load_pores(const StateReader& reader);
  std::optional<SurfacePoint<D>> surface_point(std::int64_t id) const;
  void prepare(const FlowStep<D>& step, const Topology<D>& topology);
  void assemble_chunk(std::int32_t chunk,
                      const std::function<void(std::int32_t, FlowPoints<D>&)>& fill);
  void keep(const FlowChunk<D>& chunk, const FlowPoints<D>& points);
  void fold_volume(bool again);
  void make_system(const FlowStep<D>& step, ThreadPool& pool);
  template <class Add>
  void sum_up(AlignedVector<double>& sums, Add&& add);
  void sum_matrix(const FlowStep<D>& step, ThreadPool& pool);
  void sum_once(const FlowStep<D>& step, ThreadPool& pool);
  void subtract_missed(const FlowStep<D>& step);
  void add_held(double factor);
  void finish_matrix(ThreadPool& pool);
  bool solve_system();
  void push_loads(const FlowStep<D>& step, const Topology<D>& topology, ThreadPool& pool);
  void push_groups(const FlowStep<D>& step, const std::vector<double>& force,
                   const Topology<D>& topology);
  Vec3<double> push_group(const FlowStep<D>& step, const NodeGroup<D>& group,
                          const std::vector<double>& force);
  std::array<double, 3> position(std::int64_t record, const Topology<D>& topology) const;
  void gather_run(const FlowStep<D>& step, bool ends, const FlowChunk<D>& chunk,
                  const FlowRun<D>& run);
  void settle(const double* pressure, std::int64_t first, int count);

  CouplingSetup setup_;
  FlowDomain<D> domain_;
  std::vector<FlowBody> bodies_;
  PressureLattice<D> lattice_;
  double h_;  ///< spacing of the pressure nodes [m]
  int lattices_;
  VolumeOperator<D> volume_;
  PoreCells<D> cells_;
  PressureMatrix<D> matrix_;
  PressureProduct<D> product_;
  NodeConstraints<D> constraints_;
  DrainedSurfaces<D> surfaces_;
  PressureSolver solver_;
  bool compressed_;  ///< the solver takes compressed rows, not product_
  std::vector<FlowChunk<D>> chunks_;
  PointOrder<D> order_;
  KeptPoints<D> points_;
  bool loaded_ = false;  ///< points may have moments
  /// S, H and 1/L sum Q^T M^-1 Q in the matrix's stencils; empty: not known for these points.
  AlignedVector<double> storage_, conductance_, schur_;
  bool folded_ = false;                ///< volume_, as the constraints have it
  std::vector<std::uint64_t> blocks_;  ///< of the topology that volume_ knows
  std::vector<double> solution_;       ///< by row
  /// By lattice node: pressures of the last steps, the last one first; to start from.
  std::array<std::vector<double>, 3> nodal_;
  NodeVelocities velocity_;
  std::vector<double> force_;  ///< by node
  std::vector<Reaction> reactions_;
  std::vector<double> half_side_;  ///< of each body's boxes at t = 0 [m]
  std::vector<double> biot_;       ///< of each body
  PoreStates<D> states_;
  MissedVolume missed_;
  std::vector<std::int32_t> point_of_;          ///< by place
  std::vector<std::array<double, D * D>> own_;  ///< by particle id: increments of the last step
  std::array<double, std::size_t(Part::count)> seconds_{};
  double start_mass_ = 0;        ///< of the water [kg]
  double left_ = 0;              ///< [kg], of particles that left through open faces
  std::vector<double> outflow_;  ///< [kg], through each drained surface
  int iterations_ = 0;
  SolveReport report_;  ///< of the last solve
  std::int64_t halvings_ = 0;
};

extern template class CoupledFlow<2>;
extern template class CoupledFlow<3>;

}  // namespace scree
