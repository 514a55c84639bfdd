// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/node_constraints.hpp"

#include <algorithm>
#include <cmath>

#include "solver/grid/face_fold.hpp"

namespace scree {

namespace {

/// Of a ghost's velocity along the wall, in its root's. Where a wall slips the pressure moves both
/// nodes alike, as beside a mirror plane.
std::int8_t sign_along(FaceType type, NoSlip no_slip, char state) {
  if (turns_around(type, no_slip) && state == pair_follows) return -1;
  return type == FaceType::sticky ? 0 : 1;
}

}  // namespace

/// Masses and folds are those of the last find().
template <int D>
bool NodeConstraints<D>::same_nodes(const GridDecisions<D>& grid) const {
  return mass_ == known_.mass && *grid.folded == known_.folded;
}

/// Whether what a face holds depends on the velocities.
template <int D>
bool NodeConstraints<D>::slides_or_leaves(const GridDecisions<D>& grid) {
  for (const auto& axis : grid.faces->type) {
    for (const FaceType type : axis) {
      if (type == FaceType::separate || type == FaceType::friction) return true;
    }
  }
  return false;
}

template <int D>
void NodeConstraints<D>::follow_folds(const GridDecisions<D>& grid) {
  link_.assign(mass_.size(), Link{});
  special_.assign(mass_.size(), 0);
  for (int stage = 0; stage < fold_stages; ++stage) {  // the order of the grid update
    for (int axis = 0; axis < D; ++axis) {
      const auto& pairs = (*grid.pairs)[std::size_t(axis)];
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const FacePair& pair = pairs[i];
        const char state = (*grid.folded)[std::size_t(axis)][i];
        if (pair.ghost == pair.image || state == pair_apart) continue;
        if (!(mass_[std::size_t(pair.ghost)] > 0)) continue;  // no particle sees it
        const FaceType type = grid.faces->type[std::size_t(axis)][std::size_t(pair.side)];
        if (fold_stage(type, grid.faces->no_slip) != stage) continue;
        Link& link = link_[std::size_t(pair.ghost)];
        if (link.to >= 0) continue;  // it moved away before
        const std::int8_t across = type == FaceType::periodic ? 1 : -1;
        link = {std::int32_t(pair.image), std::int8_t(axis), across,
                sign_along(type, grid.faces->no_slip, state)};
        special_[std::size_t(pair.ghost)] = special_[std::size_t(pair.image)] = 1;
      }
    }
  }
}

/// Walls through nodes. Friction that took all of the tangential velocity holds it too.
template <int D>
void NodeConstraints<D>::hold_walls(const GridDecisions<D>& grid, const NodeVelocities& velocity) {
  held_.assign(mass_.size(), 0);
  constexpr char all = char((1 << D) - 1);
  for (int axis = 0; axis < D; ++axis) {
    const char bit = char(1 << axis);
    for (const FacePair& pair : (*grid.pairs)[std::size_t(axis)]) {
      const FaceType type = grid.faces->type[std::size_t(axis)][std::size_t(pair.side)];
      if (type == FaceType::periodic || type == FaceType::open) continue;
      const double* v = velocity[pair.image];
      bool slides = false;
      for (int a = 0; a < D; ++a) slides = slides || (a != axis && v[a] != 0);
      char& held = held_[std::size_t(pair.image)];
      const bool stuck = type == FaceType::friction && !slides;
      if (pair.ghost != pair.image) {
        const Link& link = link_[std::size_t(pair.ghost)];
        const bool follows = link.to == pair.image && link.along == 1;
        if (follows && stuck) held = char(held | (all & ~bit));
        continue;
      }
      const bool may_leave = type == FaceType::separate || type == FaceType::friction;
      if (may_leave && v[axis] != 0) continue;
      held = char(held | (type == FaceType::sticky || stuck ? all : bit));
    }
  }
}

template <int D>
std::int64_t NodeConstraints<D>::root_of(std::int64_t record, Signs& sign) const {
  sign.fill(1);
  while (link_[std::size_t(record)].to >= 0) {
    const Link& link = link_[std::size_t(record)];
    for (int a = 0; a < D; ++a) {
      const int factor = a == link.axis ? link.across : link.along;
      sign[std::size_t(a)] = std::int8_t(factor * sign[std::size_t(a)]);
    }
    record = link.to;
  }
  return record;
}

/// Sets the inverse masses of nodes by themselves; returns those that are folded together, the root
/// before its ghosts.
template <int D>
auto NodeConstraints<D>::find_folds() -> std::vector<Fold> {
  auto& inverses = found_.inverse;
  inverses.resize(mass_.size());
  std::vector<Fold> folds;
  for (std::size_t r = 0; r < mass_.size(); ++r) {
    for (int a = 0; a < D; ++a) {
      const bool free = mass_[r] > 0 && (held_[r] >> a & 1) == 0;
      inverses[r][std::size_t(a)] = free ? 1 / mass_[r] : 0.0;
    }
    if (special_[r] == 0) continue;
    Signs sign;
    const std::int64_t root = root_of(std::int64_t(r), sign);
    folds.push_back({root, std::int64_t(r), sign});
    inverses[r].fill(-1);
  }
  std::sort(folds.begin(), folds.end(), [](const Fold& a, const Fold& b) {
    if (a.root != b.root) return a.root < b.root;
    if ((a.record == a.root) != (b.record == b.root)) return a.record == a.root;
    return a.record < b.record;
  });
  return folds;
}

template <int D>
void NodeConstraints<D>::make_groups() {
  auto& [inverses, groups, members] = found_;
  groups.clear();
  members.clear();
  const std::vector<Fold> folds = find_folds();
  for (std::size_t i = 0; i < folds.size();) {
    NodeGroup<D> group;
    group.root = folds[i].root;
    group.begin = std::int32_t(members.size());
    double mass[D] = {};
    for (; i < folds.size() && folds[i].root == group.root; ++i) {
      members.push_back({folds[i].record, folds[i].sign});
      for (int a = 0; a < D; ++a) {
        if (folds[i].sign[std::size_t(a)] != 0) mass[a] += mass_[std::size_t(folds[i].record)];
      }
    }
    group.end = std::int32_t(members.size());
    const char held = held_[std::size_t(group.root)];
    InverseMass<D>& inverse = inverses[std::size_t(group.root)];
    for (int a = 0; a < D; ++a) {
      const bool free = mass[a] > 0 && (held >> a & 1) == 0;
      inverse[std::size_t(a)] = group.inverse[a][a] = free ? 1 / mass[a] : 0.0;
    }
    groups.push_back(group);
  }
}

/// Takes the directions that colliders hold out of the inverse mass M^-1: with the normal n,
/// M^-1 - M^-1 n (n . M^-1 n)^-1 n^T M^-1.
template <int D>
void NodeConstraints<D>::hold_by_colliders(const NodeVelocities& velocity,
                                           const std::vector<Collider>& colliders,
                                           const double x[3], double touch,
                                           NodeGroup<D>& group) const {
  const double* v = velocity[group.root];
  for (std::size_t c = 0; c < colliders.size(); ++c) {
    const Collider& collider = colliders[c];
    if (!collider.touches(x)) continue;
    const Vec3<double> n = collider.normal(x);
    double speed = 0, normal = 0, tangential = 0, relative[D];
    for (int a = 0; a < D; ++a) {
      relative[a] = v[a] - collider.velocity()[a];
      speed = std::max({speed, std::abs(v[a]), std::abs(collider.velocity()[a])});
      normal += relative[a] * n[a];
    }
    for (int a = 0; a < D; ++a) {
      tangential = std::max(tangential, std::abs(relative[a] - normal * n[a]));
    }
    const ContactType type = collider.contact();
    const bool may_leave = type == ContactType::separate || type == ContactType::friction;
    if (may_leave && normal > touch * speed) continue;
    if (group.collider < 0) group.collider = std::int32_t(c);
    const bool stuck = type == ContactType::friction && tangential <= touch * speed;
    if (type == ContactType::sticky || stuck) {
      for (auto& row : group.inverse) std::fill(row, row + D, 0.0);
      continue;
    }
    double y[D], size = 0, largest = 0;
    for (int a = 0; a < D; ++a) {
      y[a] = 0;
      for (int b = 0; b < D; ++b) y[a] += group.inverse[a][b] * n[b];
      size += n[a] * y[a];
      largest = std::max(largest, group.inverse[a][a]);
    }
    if (!(size > 1e-12 * largest)) continue;  // another constraint holds this direction already
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) group.inverse[a][b] -= y[a] * y[b] / size;
    }
  }
}

template <int D>
std::int64_t NodeConstraints<D>::bytes() const {
  const auto of = [](const Found& f) {
    return sizeof(InverseMass<D>) * f.inverse.capacity() +
           sizeof(NodeGroup<D>) * f.groups.capacity() +
           sizeof(typename NodeGroup<D>::Member) * f.members.capacity();
  };
  return std::int64_t(8 * (mass_.capacity() + known_.mass.capacity()) + of(found_) + of(before_) +
                      sizeof(Link) * link_.capacity() + held_.capacity() + special_.capacity());
}

template class NodeConstraints<2>;
template class NodeConstraints<3>;

}  // namespace scree
