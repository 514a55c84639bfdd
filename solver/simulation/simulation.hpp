// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/boundary/collider_spec.hpp"
#include "solver/boundary/face_type.hpp"
#include "solver/boundary/traction_spec.hpp"
#include "solver/coupling/coupling_setup.hpp"
#include "solver/io/snapshot.hpp"
#include "solver/io/state_archive.hpp"
#include "solver/particles/surface.hpp"
#include "solver/simulation/method.hpp"
#include "solver/simulation/schedule.hpp"
#include "solver/simulation/step_limit.hpp"
#include "solver/simulation/volumetric_locking.hpp"

namespace scree {

/// The particles of one body at t = 0 and their law.
struct BodySetup {
  std::string name;
  std::string material;  ///< deck name
  std::string model;     ///< name of the law
  std::any input;        ///< the law's Input
  double density = 0;    ///< [kg/m^3]
  /// Bulk modulus of undrained pore water [Pa], for laws of effective stresses; 0: no pore water.
  double undrained_bulk_modulus = 0;
  std::optional<PoreSetup> pores;     ///< with SimulationSetup::coupling: water that flows
  std::vector<double> pore_pressure;  ///< of each particle at t = 0 [Pa]; empty: 0
  std::int32_t material_index = 0;
  double particle_volume = 0;             ///< [m^3] (2D: m^2)
  std::vector<double> position;           ///< 3 per particle [m]
  std::vector<double> velocity;           ///< 3 per particle [m/s]; empty = at rest
  std::vector<double> velocity_gradient;  ///< 9 per particle, dv_i/dx_j row-major [1/s]; empty = 0
  /// States of the law (entries in the order of its fields) that particles start from, and for each
  /// particle the one it has; empty: all start from the law's initial state.
  std::vector<std::vector<double>> states;
  std::vector<std::int32_t> state_of;
};

/// A load on marked particles of one body.
struct TractionSetup {
  TractionSpec spec;
  std::int32_t body = 0;
  SurfacePatch patch;  ///< particle indices are those of the body's arrays
};

/// All that a simulation needs, checked and in SI units.
struct SimulationSetup {
  int dimension = 3;
  Precision precision = Precision::double_;
  std::array<double, 3> lower{};        ///< domain's lower corner [m]
  std::array<std::int32_t, 3> cells{};  ///< cells an axis
  double cell_size = 1;                 ///< [m]
  KernelType kernel = KernelType::compact;
  TransferType transfer = TransferType::mls;
  PathType path = PathType::automatic;
  double flip_blend = 1;
  VolumetricLocking volumetric_locking = VolumetricLocking::none;  ///< fbar takes the split path
  /// Runs on a device give the same bits every time; they take the split path. (Those on the
  /// processor always do.)
  bool deterministic = false;
  double cfl = 0.4;
  std::optional<double> step;  ///< fixed step [s]; still shortened to hit events
  std::function<std::array<double, 3>(double t)> gravity;  ///< [m/s^2]; empty = none
  DampingType damping = DampingType::none;
  double damping_value = 0;
  /// Acceleration [m/s^2] at reference position X, position x, time t; empty = none. Takes the
  /// split path.
  std::function<std::array<double, 3>(const double* X, const double* x, double t)> body_force;
  std::array<std::array<FaceType, 2>, 3> faces{};  ///< [axis][lower, upper]
  std::array<std::array<double, 2>, 3> face_friction{};
  NoSlip no_slip = NoSlip::node;  ///< of sticky and friction faces
  std::vector<ColliderSpec> colliders;
  std::vector<BodySetup> bodies;
  std::vector<TractionSetup> tractions;
  /// Pore water that flows, in the bodies with pores. With halvings it takes the split path.
  std::optional<CouplingSetup> coupling;
  Schedule schedule;
  bool keep_reference = true;  ///< keep X (needed for displacement, tractions and body forces)
  bool record = true;          ///< false: no history or frames will be asked for (benchmarks)
  int threads = 1;
};

/// Memory in use [bytes].
struct MemoryReport {
  std::int64_t particles = 0;
  std::int64_t grid = 0;
  std::int64_t other = 0;
  std::int64_t total() const { return particles + grid + other; }
};

/// Bytes that one step loads and stores in particle fields and grid nodes; caches may serve part
/// of the grid's.
struct StepTraffic {
  std::int64_t particles = 0;
  std::int64_t grid = 0;
  std::int64_t total() const { return particles + grid; }
};

/// Wall-clock seconds spent in the phases of all steps so far.
using PhaseTimes = std::vector<std::pair<std::string, double>>;

/// Which particles a snapshot is of: their number and present position [m]. Asked by several
/// threads at once. Empty: all.
using ParticleFilter = std::function<bool(std::int64_t id, const double* position)>;

/// A run in memory: owns particles and grid and advances them in time; no files.
///
/// Results are bitwise the same for any number of threads, and after save/load.
class Simulation {
 public:
  /// Throws UserError for what the deck checks cannot know (a particle outside the domain, ...).
  static std::unique_ptr<Simulation> create(SimulationSetup setup);
  virtual ~Simulation() = default;

  /// Advances by dt(). Throws RunFault; the state is then of no further use.
  virtual void step() = 0;

  virtual double time() const = 0;       ///< [s]
  virtual double dt() const = 0;         ///< the coming step [s]
  virtual double next_time() const = 0;  ///< time() after the coming step [s]
  virtual std::int64_t step_count() const = 0;
  virtual std::int64_t particle_count() const = 0;
  virtual std::int64_t removed_count() const = 0;  ///< particles that left through open faces
  virtual bool fused() const = 0;
  virtual bool coupled() const { return false; }  ///< with pore water that flows
  virtual bool loaded() const { return false; }   ///< with tractions or body forces

  // Valid when the schedule says that history or a frame is due at time().
  virtual HistoryRow history() const = 0;
  /// Named fields: those of particle_fields() and material history. The snapshot's own id, material
  /// and body may be named too, and add nothing. Throws UserError for other names.
  ParticleSnapshot particles(const std::vector<std::string>& fields) const {
    return particles(fields, {});
  }
  virtual ParticleSnapshot particles(const std::vector<std::string>& fields,
                                     const ParticleFilter& filter) const = 0;
  /// The node velocities and masses of the last step, one snapshot a lattice.
  virtual std::vector<GridSnapshot> grid() const = 0;

  virtual void save(StateWriter& writer) const = 0;
  /// Continues where save() was called, bit for bit; the setup must be the same.
  virtual void load(const StateReader& reader) = 0;

  virtual std::int64_t block_count() const = 0;  ///< active grid blocks
  virtual MemoryReport memory() const = 0;
  virtual PhaseTimes phases() const = 0;
  /// Of a fused step without pore water that flows; 0 of others.
  virtual StepTraffic traffic() const { return {}; }
  /// What bounds the coming step. After load() the places are known from the next step on.
  virtual StepLimit step_limit() const { return {}; }
};

}  // namespace scree
