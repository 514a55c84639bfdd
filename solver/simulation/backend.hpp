// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "solver/boundary/collider.hpp"
#include "solver/exec/aligned.hpp"
#include "solver/grid/grid.hpp"
#include "solver/grid/grid_update.hpp"
#include "solver/simulation/method.hpp"
#include "solver/step/body.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// A body of a run.
template <int D, class T>
struct BodyState {
  std::unique_ptr<Body<D, T>> body;
  std::int64_t first_id = 0;
  std::int64_t dead = 0;  ///< particles marked dead that the next binning drops
};

/// The block of a body where something is largest.
template <int D>
struct BlockPlace {
  int body = -1;  ///< -1: not known
  BlockCoord<D> block{};
};

/// What a backend must know of the method; the same over a run.
template <int D>
struct BackendConfig {
  KernelType kernel = KernelType::compact;
  TransferType transfer = TransferType::mls;
  bool fused = true;
  bool separate_force = false;  ///< forces are scattered to channel 1 (flip, local damping)
  bool deterministic = false;   ///< device, split path: the same bits in every run
  GridDomain<D> domain;
  Faces<D> faces;
  /// First aux field of those that average_volumes() keeps (VolumeFields); -1: it is not called.
  int volume_ratio = -1;
  std::array<double, 3> lower{};  ///< domain's lower corner [m]
  double cell_size = 1;           ///< [m]
};

/// What the passes report since the last report. The first fault, in the order of bodies and
/// blocks.
template <int D>
struct PassReport {
  struct Fault {
    FaultCode code = FaultCode::none;
    int body = 0;
    BlockCoord<D> block{};
    std::int64_t id = -1;
    double value = 0;
    std::array<double, D> position{};  ///< cells from the block's lower corner
  };
  double max_speed = 0;  ///< of g2p or g2p2g: max |v_a| [m/s]
  BlockPlace<D> fastest;
  double max_excursion = 0;        ///< of the same [cells]
  std::vector<std::int64_t> dead;  ///< of the same: a body's particles that left
  double max_signal = 0;           ///< of stress or g2p2g: max of wave speed + |v| [m/s]
  BlockPlace<D> stiffest;
  double grid_mass = 0;  ///< of the last grid update: mean over the lattices [kg]
  Fault fault;
};

/// A grid between its update and the gather, for what solves there for other velocities.
template <int D, class T>
struct UpdatedGrid {
  AlignedVector<T>* velocities = nullptr;  ///< may be changed
  AlignedVector<T>* changes = nullptr;     ///< velocity changes of the update, with separate_force
  GridUpdate<D, T>* update = nullptr;      ///< what it decided, and its reactions
};

/// What loads need of a particle, and what they give it.
template <int D>
struct LoadedParticle {
  std::int64_t id = -1;
  int body = 0;
  std::array<double, D> cells{};          ///< position, cells from the domain's lower corner
  std::array<double, D> velocity{};       ///< [m/s]
  std::array<double, D * D> increment{};  ///< dt grad v of the last step
  std::array<double, D> acceleration{};   ///< force per mass of the last step [m/s^2]
};

/// Where a run computes: it holds the particles and the grid while the run steps.
///
/// The order of a step, its length, loads and output are the simulation's; a backend offers the
/// parts of a step. Work may be done later than it is asked for; report() waits for it.
template <int D, class T>
class Backend {
 public:
  using Bodies = std::vector<BodyState<D, T>>;
  using Parameters = std::vector<PassParameters<T>>;  ///< one a body
  virtual ~Backend() = default;

  /// Takes the particles of the bodies' stores and finds the blocks anew: at the start and after
  /// load.
  virtual void take_particles() = 0;
  /// Brings the bodies' stores up to date: all particles in the backend's order, the dead included.
  virtual void give_particles() = 0;
  /// Takes `count` aux fields from the stores, the first at `first`, after give_particles().
  virtual void take_aux(int first, int count) = 0;
  /// Loads act on these particles alone, by id in ascending order. True where the backend brings
  /// them by read_loaded() with less work than all; then neither give_particles() nor take_aux() is
  /// needed for loads.
  virtual bool load_only(const std::vector<std::int64_t>&) { return false; }
  /// Those of load_only() that are still there, by body and id, until the next call.
  virtual std::vector<LoadedParticle<D>>& read_loaded() { throw std::logic_error("no such list"); }
  /// Takes the accelerations of what read_loaded() has given, in its order.
  virtual void write_loaded() {}
  /// Changes where aux fields lie; their contents are lost where their number changes.
  virtual void set_layout(const AuxLayout& layout) = 0;
  virtual std::int64_t count(std::size_t body) const = 0;  ///< particles, the dead included

  /// Moves strays to the block they are in and drops dead particles; wrap as for ParticleStore. The
  /// momenta of a fused run move along.
  virtual void bin(const std::array<std::int32_t, D>& wrap) = 0;

  /// Particles to a grid that is cleared before.
  virtual void p2g(const Parameters& parameters) = 0;
  /// Momenta to velocities.
  virtual void update_grid(const GridForces& forces, std::vector<Collider>& colliders) = 0;
  virtual void g2p(const Parameters& parameters) = 0;
  /// After g2p(): gives the stored dt grad v the mean change of volume of its surroundings, body by
  /// body. Only with BackendConfig::volume_ratio, which a backend may refuse.
  virtual void average_volumes(const Parameters&) {}
  virtual void stress(const Parameters& parameters) = 0;
  /// What the next g2p2g() is in its stride, where there are any. A backend without coupling needs
  /// none.
  virtual void set_stride(const StrideStep<T>&) {}
  /// Velocities to particles and on to the momenta of the next step.
  virtual void g2p2g(const Parameters& parameters) = 0;
  virtual PassReport<D> report() = 0;

  /// Reactions of the last grid update whose report was read, one a collider; empty before.
  virtual const std::vector<Reaction>& reactions() const = 0;
  virtual const Grid<D, T>& grid() const = 0;  ///< the blocks and how their nodes lie
  /// Node records of the last grid update's velocities; of other length before the first.
  virtual const AlignedVector<T>& velocities() = 0;
  /// Fused: what the last step scattered for the next one.
  virtual const AlignedVector<T>& momenta() = 0;
  virtual void set_momenta(const std::vector<T>& values) = 0;

  /// What update_grid() updates, or has updated. Nothing where the grid is out of the processor's
  /// reach; such a backend takes no coupling.
  virtual UpdatedGrid<D, T> updated_grid() { return {}; }

  virtual std::int64_t grid_bytes() const = 0;
  virtual std::int64_t other_bytes() const = 0;  ///< beside stores and grid
};

}  // namespace scree
