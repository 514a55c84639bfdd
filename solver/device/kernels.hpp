// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "solver/boundary/contact_type.hpp"
#include "solver/boundary/face_type.hpp"
#include "solver/device/device.hpp"
#include "solver/exec/fixed_channels.hpp"
#include "solver/simulation/method.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// What the blocks of a body report together.
template <class T>
struct BodySummary {
  T max_speed;
  T max_signal;
  T max_excursion;
  std::int32_t fastest;      ///< block of max_speed, the first where there are several; -1: none
  std::int32_t stiffest;     ///< the same of max_signal
  std::int32_t dead;         ///< particles that left
  std::int32_t fault_block;  ///< first block with a fault; -1: none
  BlockResult<T> fault;      ///< of that block
};

/// Node records of a channel, block after block.
template <class T>
struct NodePass {
  T* p = nullptr;  ///< channel 0
  T* q = nullptr;  ///< channel 1, null without separate forces
  std::int32_t blocks = 0;
  std::int32_t block_nodes = 0;  ///< of all lattices
  T kick[3] = {0, 0, 0};         ///< dt g [m/s]
  T keep = 1;                    ///< factor of mass damping
  T local = 0;                   ///< fraction of local damping
};

/// Pairs of one axis, grouped by lines along it: those of line l are line_begin[l] ..
/// line_begin[l + 1] - 1. Lines share no node.
struct FoldLines {
  const std::int32_t* line_begin = nullptr;
  std::int32_t lines = 0;
  const std::int64_t* ghost = nullptr;  ///< record indices
  const std::int64_t* image = nullptr;
  const std::int32_t* side = nullptr;
  std::int8_t* folded = nullptr;  ///< a PairState per pair
  int axis = 0;
  FaceType type[2] = {FaceType::open, FaceType::open};
  double friction[2] = {0, 0};
  NoSlip no_slip = NoSlip::node;
};

/// Nodes within colliders. Contacts of node n are begin[n] .. begin[n + 1] - 1, in the colliders'
/// order.
struct ContactNodes {
  std::int32_t nodes = 0;
  const std::int64_t* record = nullptr;  ///< per node
  const std::int32_t* begin = nullptr;
  const std::int32_t* collider = nullptr;  ///< per contact
  const double* normal = nullptr;          ///< 3 per contact
  double* impulse = nullptr;               ///< 3 per contact, out: on the collider [kg m/s]
  std::int8_t* holds = nullptr;            ///< per contact, out: the collider holds something of v
  double* settled = nullptr;  ///< 3 per node, out: its velocity after local damping [m/s]
};

/// A collider in a step.
struct ContactSurface {
  ContactType type = ContactType::separate;
  double coefficient = 0;
  double velocity[3] = {0, 0, 0};  ///< [m/s]
  double centre[3] = {0, 0, 0};    ///< torques are about it [m]
};

/// Contacts by collider, for the reactions: those of collider c are list[begin[c]] ..
struct ContactSums {
  std::int32_t colliders = 0;
  const std::int32_t* begin = nullptr;
  const std::int32_t* list = nullptr;
  const double* position = nullptr;  ///< 3 per contact [m]
};

/// The particles of a body on a device.
template <class T>
struct ParticlePools {
  T* particles = nullptr;
  T* aux = nullptr;
  std::int64_t* ids = nullptr;
  std::int32_t fields = 0;
  std::int32_t aux_fields = 0;
};

/// Chosen particles of a body, and a row of values for each: position, velocity, increment and
/// external force.
template <class T>
struct ChosenRows {
  const std::int64_t* ids = nullptr;  ///< ascending
  std::int32_t* lane = nullptr;       ///< of each; -1: gone
  T* rows = nullptr;
  std::int32_t count = 0;
};

/// What is launched on a device, on plain pointers to its memory. `blocks`: those of a body.
template <int D, class T>
class DeviceKernels {
 public:
  virtual ~DeviceKernels() = default;

  virtual void p2g(KernelType, TransferType, const PassData<D, T>&, int blocks) = 0;
  /// p2g with sums in fixed point.
  virtual void p2g_fixed(KernelType, TransferType, const PassData<D, T>&, const FixedChannels&,
                         int blocks) = 0;
  /// The sums of a channel as numbers. After an overflow all momenta are NaN: the next pass reports
  /// it.
  virtual void from_fixed(const FixedChannels&, int channel, std::int64_t values, T* out) = 0;
  virtual void g2p(KernelType, TransferType, const PassData<D, T>&, int blocks) = 0;
  virtual void summarise(const BlockResult<T>* results, int blocks, BodySummary<T>* out) = 0;

  /// Adds dt g (and the impulses of q) to the momenta; *mass: sum over all nodes / lattices.
  virtual void add_forces(const NodePass<T>&, int lattices, double* block_mass, double* mass) = 0;
  /// Faces of one stage, see fold_stage.
  virtual void fold(const FoldLines&, int stage, T* p, T* before) = 0;
  virtual void fold_periodic(const FoldLines&, T* p) = 0;
  virtual void unfold(const FoldLines&, int stage, T* p, T* q) = 0;
  virtual void divide(const NodePass<T>&) = 0;
  /// q <- p - q.
  virtual void subtract(const NodePass<T>&) = 0;
  virtual void touch(const ContactNodes&, const ContactSurface*, const NodePass<T>&) = 0;
  /// Local damping of all nodes; those in contact get what touch() has settled.
  virtual void damp(const NodePass<T>&, const ContactNodes&) = 0;
  /// reactions: force and torque x step length x lattices, 6 a collider.
  virtual void react(const ContactSums&, const ContactSurface*, const double* impulse,
                     double* reactions) = 0;
  /// Block b of `to` becomes block from_block[b] of `from`, or zero where that is -1.
  virtual void carry_over(const std::int32_t* from_block, int blocks, int block_values,
                          const T* from, T* to) = 0;

  /// The key of the block that each lane's particle is in now, ~0 for the dead and for padding;
  /// positions become those in that block. values: 0, 1, 2, ...
  virtual void find_homes(const PassData<D, T>&, int blocks, const std::int32_t* wrap,
                          std::uint64_t* keys, std::int32_t* values) = 0;
  /// Particle i of block b comes from lane order[first[b] + i]; batches from batch_begin[b] on.
  virtual void move(const ParticlePools<T>& from, const ParticlePools<T>& to, int blocks,
                    const std::int32_t* order, const std::int32_t* first,
                    const std::int32_t* counts, const std::int32_t* batch_begin) = 0;

  /// The lanes of chosen particles, where their particle is there; others are left alone.
  virtual void find_chosen(const PassData<D, T>&, int blocks, const ChosenRows<T>&) = 0;
  /// Fills the rows of those that are there.
  virtual void read_chosen(const PassData<D, T>&, const ChosenRows<T>&) = 0;
  /// Takes the external forces of those that are there, D a row.
  virtual void write_chosen(const PassData<D, T>&, const ChosenRows<T>&) = 0;
};

/// The passes with code of one law.
template <int D, class T>
class DeviceLaw {
 public:
  virtual ~DeviceLaw() = default;
  virtual void g2p2g(KernelType, const PassData<D, T>&, int blocks) const = 0;
  virtual void stress(const PassData<D, T>&, int blocks) const = 0;
};

}  // namespace scree
