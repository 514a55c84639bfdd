// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "solver/grid/block.hpp"

namespace scree {

/// Where the aux fields of a particle lie (index of the first entry, -1 = absent) and how many
/// there are.
struct AuxLayout {
  int velocity = -1;   ///< D entries [m/s]
  int affine = -1;     ///< D*D entries, B = 1/2 sum w v (x_i - x_p)^T in units of m/s x cells
  int stress = -1;     ///< 6 entries, Kirchhoff stress [Pa]: xx, xy, xz, yy, yz, zz
  int increment = -1;  ///< D*D entries, dt grad v of the last step (split path) or stride
  int external = -1;   ///< D entries, external force per mass [m/s^2] (loads, gained water)
  int total = 0;
};

/// More of them, on the fused path with pore water (stride_ops.hpp).
struct StrideFields {
  int growth = -1;    ///< relative change of volume since the stride's start
  int gained = -1;    ///< mass of the gained water over the particle's
  int gathered = -1;  ///< D entries, with records: position in the last gather [cells from the
                      ///< block's lower corner]
  int ahead = -1;  ///< D entries, with records: how far the particle is from its position [cells]

  /// Entries of a particle with these behind `others`.
  int end(int others, int dimension) const {
    if (growth < 0) return others;
    if (ahead >= 0) return ahead + dimension;
    return (gained >= 0 ? gained : growth) + 1;
  }
};

/// What went wrong with a particle in a pass.
enum class FaultCode : std::int32_t {
  none = 0,
  moved_too_far = 1,  ///< left its block's region within one step; value = displacement [cells]
  inadmissible_state = 2,  ///< the material cannot represent the state (det F <= 0, ...)
  not_finite = 3,          ///< a velocity is not a number
  left_domain = 4,         ///< beyond a closed face by more than a cell; value = depth [cells]
};

/// What a pass over one block reports.
template <class T>
struct BlockResult {
  T max_speed = 0;        ///< max over particles and axes of |v_a| [m/s]
  T max_signal = 0;       ///< max of wave speed + |v| [m/s]
  T max_excursion = 0;    ///< farthest stray outside the home region [cells]
  std::int32_t dead = 0;  ///< particles that left through an open face in this pass
  FaultCode fault = FaultCode::none;
  std::int64_t fault_id = -1;
  T fault_value = 0;
  T fault_position[3] = {0, 0, 0};  ///< cells from the block's lower corner
};

/// Numbers that are the same for all blocks of a body in one pass.
template <class T>
struct PassParameters {
  T dt = 0;                      ///< step that the gathered velocities belong to [s]
  T dt_next = 0;                 ///< step that the scattered forces belong to [s]
  T cell_size = 1;               ///< [m]
  T particle_mass = 0;           ///< [kg] (2D: per metre)
  T particle_volume = 0;         ///< reference volume V0 [m^3] (2D: m^2)
  T undrained_bulk_modulus = 0;  ///< of the pore water; 0 = the particles have no pore pressure
  T flip_blend = 1;              ///< flip: share of the increment form, 0 = pic
  bool record = false;           ///< fused pass: also store velocity, affine matrix and stress
  bool separate_force = false;   ///< scatter forces into channel 1 (flip, local damping)
  T alive_lower[3];  ///< a particle outside [alive_lower, alive_upper) is removed [cells]
  T alive_upper[3];
  T closed_lower[3];  ///< a particle outside these is a fault [cells]
  T closed_upper[3];
  T wrap_lower[3];  ///< a particle outside these counts as a stray (periodic faces) [cells]
  T wrap_upper[3];

  // What derive() makes of the numbers above; on a GPU a division is too dear to be made by each
  // particle, and a register too dear to keep its result.
  T step_over_cell = 0;   ///< dt/dx [s/m]
  T impulse_scale = 0;    ///< -dt_next V0/dx: stress -> impulse [m^2 s] (2D: m s)
  T water_stiffness = 0;  ///< undrained_bulk_modulus over density [m^2/s^2]

  void derive() {
    step_over_cell = dt / cell_size;
    impulse_scale = -dt_next * particle_volume / cell_size;
    water_stiffness = undrained_bulk_modulus / (particle_mass / particle_volume);
  }
};

/// A step within its stride (stride_ops.hpp), where there are any. Channel 1 then holds the nodes'
/// displacements since the stride's start, this step's included [m].
template <class T>
struct StrideStep {
  StrideFields fields;
  bool begins = true;             ///< the step is the first of its stride
  bool ends = true;               ///< it is the last: particles go to where they have got
  int steps = 1;                  ///< of the stride, this one included
  T gravity_next[3] = {0, 0, 0};  ///< in the step that the scattered forces belong to [m/s^2]

  /// Whether the pass gathers from channel 1; record: PassParameters'.
  SCREE_FN bool sums(bool record) const { return ends ? !begins : record; }
};

/// Flat view of a body's particles and of the grid: all that a pass needs, plain pointers.
template <int D, class T>
struct PassData {
  PassParameters<T> parameters;
  AuxLayout layout;
  int fields = 0;
  T* particles = nullptr;  ///< batch b at particles + b * fields * width
  T* aux = nullptr;        ///< batch b at aux + b * layout.total * width
  std::int64_t* ids = nullptr;
  const std::int32_t* batch_begin = nullptr;  ///< per body block
  const std::int32_t* batch_list = nullptr;
  const std::int32_t* counts = nullptr;
  const std::int32_t* grid_block = nullptr;  ///< body block -> block of the topology
  const std::int32_t* coords = nullptr;      ///< D block coordinates per body block
  const std::int32_t* neighbours = nullptr;  ///< topology's table, 3^D per grid block
  const T* read[2] = {nullptr, nullptr};     ///< grid channels gathered from
  T* write[2] = {nullptr, nullptr};          ///< grid channels scattered to
  BlockResult<T>* results = nullptr;         ///< one per body block
  StrideStep<T> stride;  ///< last: what a GPU's kernels read lies where it did without it
};

}  // namespace scree
