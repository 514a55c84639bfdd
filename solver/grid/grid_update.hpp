// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/boundary/collider.hpp"
#include "solver/exec/thread_pool.hpp"
#include "solver/grid/face_pairs.hpp"
#include "solver/grid/node_updates.hpp"
#include "solver/simulation/method.hpp"

namespace scree {

/// What the grid equation of motion needs besides momenta.
struct GridForces {
  double dt = 0;                    ///< [s]
  std::array<double, 3> gravity{};  ///< [m/s^2]
  DampingType damping = DampingType::none;
  double damping_value = 0;     ///< local: fraction; mass: 1/s
  bool separate_force = false;  ///< channel 1 holds impulses, channel 0 momenta before forces

  /// Share of a velocity that mass damping leaves in the step.
  double kept() const { return damping == DampingType::mass ? 1 / (1 + dt * damping_value) : 1; }
  /// Share of the unbalanced force that local damping turns against the velocity.
  double opposed() const { return damping == DampingType::local ? damping_value : 0; }
};

/// Force and torque (about its reference point) on a collider in a step: what the material exerts,
/// whatever damping there is.
struct Reaction {
  std::array<double, 3> force{};   ///< [N] (2D: N/m)
  std::array<double, 3> torque{};  ///< [N m] (2D: N)
};

/// Turns the scattered momenta into velocities under gravity, damping, faces and colliders
/// (numerics: v = (m v)/m + dt (f/m + g), then boundaries, on every lattice, each node at its true
/// position).
template <int D, class T>
class GridUpdate {
 public:
  /// lower: the domain's lower corner [m]; cell_size [m].
  GridUpdate(const GridDomain<D>& domain, const Faces<D>& faces, std::array<double, 3> lower,
             double cell_size);

  /// Must be called when the grid's blocks have changed.
  void rebuild(const Grid<D, T>& grid);

  /// channel 0: momentum and mass in, velocity and mass out. channel 1 (separate_force): impulse
  /// in, velocity change out. Returns the mean mass over the lattices [kg].
  double apply(const Grid<D, T>& grid, AlignedVector<T>& channel_0, AlignedVector<T>& channel_1,
               const GridForces& forces, std::vector<Collider>& colliders, ThreadPool& pool);

  /// Adds what lies beyond periodic faces to the images within, on momenta; before blocks change.
  void fold_periodic(AlignedVector<T>& channel) const;
  /// Masses of nodes, one a record: ghosts beyond periodic faces give theirs to their images. Then
  /// all ghosts of a node with mass get next to none, which says that particles may see them: those
  /// that scattered may have been moved to the other side since then.
  void move_periodic(std::vector<double>& masses) const;

  /// Reactions of the last apply(), one a collider.
  const std::vector<Reaction>& reactions() const { return reactions_; }
  /// What a later part of the step adds to them.
  void add_reactions(const std::vector<Reaction>& more);

  // What the last apply() did at the faces.
  const Faces<D>& faces() const { return faces_; }
  const FacePairs<D>& pairs() const { return pairs_; }
  const std::array<std::vector<char>, D>& folded() const { return folded_; }

 private:
  void remember(const std::vector<std::uint64_t>& keys);
  void find_face_blocks(const Grid<D, T>& grid);
  void add_forces(const Grid<D, T>& grid, std::int64_t block, T* p, T* q, const GridForces& forces);
  void fold(T* p, T* q, bool separate);
  void fold_run(int axis, const FaceRun& run, T* p, T* before);
  void hold_wall(const FacePair& pair, int axis, T* p, T* before) const;
  char fold_pair_of_nodes(const FacePair& pair, int axis, T* p, T* before) const;
  void unfold(T* p, T* q, bool separate) const;
  void to_velocity(const Grid<D, T>& grid, T* p, T* q, const GridForces& forces,
                   std::vector<Collider>& colliders, ThreadPool& pool);
  void update_block(const Grid<D, T>& grid, std::int64_t block, T* p, T* q,
                    const GridForces& forces, std::vector<Collider>& colliders);
  /// Of a node of the block, by its record, m.
  std::array<double, 3> position(const Grid<D, T>& grid, std::int64_t block, int i) const;
  void touch_block(const Grid<D, T>& grid, std::int64_t block, T* nodes, const T* before, T local,
                   T keep, const std::vector<Collider>& colliders);
  void touch_node(const std::array<double, 3>& x, int i, double mass, T* v,
                  const std::vector<Collider>& colliders, std::vector<BlockContactMemory>& memory,
                  Reaction* reactions, std::vector<HeldDirection>& held) const;
  bool near_block(const Grid<D, T>& grid, std::int64_t block, const Collider& collider,
                  BlockContactMemory& memory) const;

  GridDomain<D> domain_;
  Faces<D> faces_;
  std::array<double, 3> lower_;
  double cell_size_;
  FacePairs<D> pairs_;
  std::array<std::vector<char>, D> folded_;  ///< a PairState per pair
  std::array<std::vector<FaceRun>, D> runs_;
  std::int64_t records_ = 1;               ///< of a block
  std::vector<std::int64_t> face_blocks_;  ///< that hold nodes of pairs
  std::vector<char> beside_face_;          ///< by block: whether it is one of them
  std::vector<char> occupied_;             ///< by block: whether its nodes have masses
  /// Per block, then per collider (or none yet); remembered_ are the keys of these blocks.
  std::vector<std::vector<BlockContactMemory>> memory_;
  std::vector<std::uint64_t> remembered_;
  std::vector<double> block_mass_;
  std::vector<Reaction> block_reactions_;
  std::vector<Reaction> reactions_;
};

extern template class GridUpdate<2, float>;
extern template class GridUpdate<2, double>;
extern template class GridUpdate<3, float>;
extern template class GridUpdate<3, double>;

}  // namespace scree
