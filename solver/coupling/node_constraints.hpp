// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "solver/boundary/collider.hpp"
#include "solver/coupling/volume_operator.hpp"
#include "solver/grid/face_pairs.hpp"

namespace scree {

/// What the grid update has decided about faces.
template <int D>
struct GridDecisions {
  const Faces<D>* faces = nullptr;
  const FacePairs<D>* pairs = nullptr;
  const std::array<std::vector<char>, D>* folded = nullptr;  ///< a PairState per pair
};

/// A velocity node with what moves with it: ghosts beyond walls and periodic faces that the grid
/// update folded onto it, each axis with the sign of its image, and the directions that walls and
/// colliders hold.
template <int D>
struct NodeGroup {
  struct Member {
    std::int64_t record;
    std::array<std::int8_t, D> sign;  ///< of the root's velocity; 0: held
    bool operator==(const Member&) const = default;
  };
  std::int64_t root = 0;
  std::int32_t begin = 0, end = 0;  ///< members, the root first
  double inverse[D][D] = {};        ///< constrained inverse mass [1/kg]
  std::int32_t collider = -1;       ///< that holds it, -1: none, and inverse is diagonal
  bool operator==(const NodeGroup&) const = default;
};

/// The inverse mass of the velocity nodes under the constraints of the step.
///
/// Contact is what the grid update found for the velocities before the pressure acts: they hold the
/// effective stress, so a wall pushes back, and rubs, by the effective stress on it. A node in
/// contact is then held in the wall's direction (where friction stopped it, in all), and the
/// pressure changes only what is free; what it presses on the wall goes into the reaction.
template <int D>
class NodeConstraints {
 public:
  /// Masses of the nodes as scattered, before faces fold them; set by the caller in every step.
  std::vector<double>& masses() { return mass_; }

  /// The nodes are others than in the last find().
  void forget() { known_ = {}; }
  std::int64_t bytes() const;

  /// velocity: after the grid update. position(record): of a node [m].
  /// `touch`: relative velocities below this share of a node's speed count as contact.
  template <class Position>
  void find(const GridDecisions<D>& grid, const NodeVelocities& velocity,
            const std::vector<Collider>& colliders, Position&& position, double touch);
  /// Whether the last find() found what the one before it had found.
  bool unchanged() const { return unchanged_; }

  const std::vector<InverseMass<D>>& inverse() const { return found_.inverse; }
  const std::vector<NodeGroup<D>>& groups() const { return found_.groups; }
  const std::vector<typename NodeGroup<D>::Member>& members() const { return found_.members; }
  double mass(std::int64_t record) const { return mass_[std::size_t(record)]; }

 private:
  using Signs = std::array<std::int8_t, D>;
  bool same_nodes(const GridDecisions<D>& grid) const;
  static bool slides_or_leaves(const GridDecisions<D>& grid);
  void follow_folds(const GridDecisions<D>& grid);
  template <class Position>
  void hold_nodes(const NodeVelocities& velocity, const std::vector<Collider>& colliders,
                  Position&& position, double touch);
  void hold_walls(const GridDecisions<D>& grid, const NodeVelocities& velocity);
  std::int64_t root_of(std::int64_t record, Signs& sign) const;
  struct Fold {
    std::int64_t root, record;
    Signs sign;
  };
  std::vector<Fold> find_folds();
  void make_groups();
  void hold_by_colliders(const NodeVelocities& velocity, const std::vector<Collider>& colliders,
                         const double x[3], double touch, NodeGroup<D>& group) const;

  struct Link {
    std::int32_t to = -1;
    std::int8_t axis = 0;
    std::int8_t across = 1, along = 1;  ///< factors of the velocity it follows
  };
  /// What the last find() but for its velocities found from.
  struct Known {
    std::vector<double> mass;
    std::array<std::vector<char>, D> folded;
    std::vector<char> held;
  };
  struct Found {
    std::vector<InverseMass<D>> inverse;
    std::vector<NodeGroup<D>> groups;
    std::vector<typename NodeGroup<D>::Member> members;
    bool operator==(const Found&) const = default;
  };
  std::vector<double> mass_;  ///< before folding
  Known known_;
  bool unchanged_ = false;
  Found found_, before_;
  std::vector<Link> link_;     ///< by record; to < 0: not folded
  std::vector<char> held_;     ///< by record: bit a: axis a is held
  std::vector<char> special_;  ///< by record: root or ghost of a fold
};

template <int D>
template <class Position>
void NodeConstraints<D>::find(const GridDecisions<D>& grid, const NodeVelocities& velocity,
                              const std::vector<Collider>& colliders, Position&& position,
                              double touch) {
  const bool same = same_nodes(grid);
  if (!same) follow_folds(grid);
  if (!same || slides_or_leaves(grid)) hold_walls(grid, velocity);
  unchanged_ = same && held_ == known_.held;
  if (unchanged_ && colliders.empty()) return;
  if (!unchanged_) known_ = {mass_, *grid.folded, held_};
  std::swap(found_, before_);
  make_groups();
  hold_nodes(velocity, colliders, position, touch);
  unchanged_ = unchanged_ && found_ == before_;
}

/// What colliders hold.
template <int D>
template <class Position>
void NodeConstraints<D>::hold_nodes(const NodeVelocities& velocity,
                                    const std::vector<Collider>& colliders, Position&& position,
                                    double touch) {
  if (colliders.empty()) return;
  auto& [inverse, groups, members] = found_;
  std::vector<NodeGroup<D>> touched;
  for (NodeGroup<D>& group : groups) {
    const std::array<double, 3> x = position(group.root);
    hold_by_colliders(velocity, colliders, x.data(), touch, group);
    if (group.collider >= 0) inverse[std::size_t(group.root)].fill(-1);
  }
  for (std::size_t r = 0; r < mass_.size(); ++r) {
    if (!(mass_[r] > 0) || special_[r] != 0) continue;
    NodeGroup<D> group;
    group.root = std::int64_t(r);
    for (int a = 0; a < D; ++a) group.inverse[a][a] = inverse[r][std::size_t(a)];
    const std::array<double, 3> x = position(group.root);
    hold_by_colliders(velocity, colliders, x.data(), touch, group);
    if (group.collider < 0) continue;
    group.begin = std::int32_t(members.size());
    Signs ones;
    ones.fill(1);
    members.push_back({group.root, ones});
    group.end = std::int32_t(members.size());
    inverse[r].fill(-1);
    touched.push_back(group);
  }
  groups.insert(groups.end(), touched.begin(), touched.end());
}

extern template class NodeConstraints<2>;
extern template class NodeConstraints<3>;

}  // namespace scree
