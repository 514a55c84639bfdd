// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Plain copies of a simulation's state, as they are written to files. All in SI units; in two
/// dimensions extensive quantities are per metre of thickness.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scree {

/// One named field of a snapshot. `values[i * components + c]` is component c at particle or node
/// i; a tensor has 9 components in row-major order.
struct SnapshotField {
  std::string name;
  std::string unit;  ///< for people, "" where the field has none
  int components = 1;
  std::vector<double> values;
};

/// All particles at one time, sorted by `id`.
struct ParticleSnapshot {
  double time = 0;        ///< s
  std::int64_t step = 0;  ///< steps done
  int dimension = 3;
  std::vector<double> position;  ///< m, 3 per particle (z = 0 in two dimensions)
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> material;  ///< index in the deck's order
  std::vector<std::int32_t> body;      ///< index in the deck's order
  std::vector<SnapshotField> fields;
};

/// One lattice of grid nodes at one time; node (i, j, k) has index (k * ny + j) * nx + i.
struct GridSnapshot {
  double time = 0;
  std::int64_t step = 0;
  std::string lattice;  ///< "minus" and "plus" (the compact kernel's two) or "nodes"; "pressure"
  double origin[3] = {0, 0, 0};       ///< m, position of node (0, 0, 0)
  double spacing = 0;                 ///< m
  std::int64_t nodes[3] = {0, 0, 1};  ///< nodes an axis; 1 along z in two dimensions
  std::vector<SnapshotField> fields;
};

/// Sums over all water that flows in pores.
struct FluidBalance {
  double mass = 0;     ///< in the pores now [kg]
  double outflow = 0;  ///< that left since t = 0 [kg]
  double error = 0;    ///< (mass + outflow - mass at t = 0) over mass at t = 0
  int iterations = 0;  ///< of the last step's solve for the pressure
  /// Of `outflow`, what left through each drained surface [kg], in the deck's order.
  std::vector<double> surfaces;
  std::int64_t halvings = 0;  ///< of steps whose solve did not converge, since t = 0
};

/// One row of history.csv. Momenta are those of the particles, the angular one with the affine
/// part.
struct HistoryRow {
  std::int64_t step = 0;
  double time = 0;  ///< s
  double dt = 0;    ///< s, of the step that ended at `time`; of the coming step at step 0
  std::int64_t particle_count = 0;
  double mass = 0;                         ///< kg
  double momentum[3] = {0, 0, 0};          ///< kg m/s
  double angular_momentum[3] = {0, 0, 0};  ///< kg m^2/s, about the origin
  double center[3] = {0, 0, 0};            ///< m, centre of mass
  double kinetic_energy = 0;               ///< J
  double elastic_energy = 0;               ///< J
  double max_speed = 0;                    ///< m/s
  /// force (N) and torque (N m) on each collider, in the deck's order
  std::vector<std::array<double, 6>> collider_force_torque;
  /// Work that each collider has done on the particles since t = 0 [J].
  std::vector<double> collider_work;
  /// With tractions or body forces: the work that they have done since t = 0 [J].
  std::optional<double> external_work;
  std::optional<FluidBalance> fluid;  ///< with coupled pore water
};

}  // namespace scree
