// SPDX-License-Identifier: Apache-2.0
#include "solver/grid/grid_update.hpp"

#include <cmath>

#include "solver/boundary/contact.hpp"
#include "solver/grid/face_fold.hpp"

namespace scree {
namespace {

/// A node's record {vector, mass} in one register.
template <class T>
using Record [[gnu::vector_size(4 * sizeof(T)), gnu::may_alias]] = T;

/// Adds mass x kick to each momentum; returns the sum of the masses.
template <class T>
double kick_nodes(T* nodes, std::size_t count, const T (&kick)[3]) {
  const Record<T> step{kick[0], kick[1], kick[2], T(0)};
  double sum[4] = {0, 0, 0, 0};  // of every fourth node: sums that do not wait for each other
  for (std::size_t i = 0; i < count; ++i) {
    Record<T>& node = reinterpret_cast<Record<T>*>(nodes)[i];
    const T mass = node[mass_slot];
    node += mass * step;
    sum[i % 4] += mass;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Momentum -> velocity x keep; nodes without mass rest.
template <class T>
void divide_by_mass(T* nodes, std::size_t count, T keep) {
  for (std::size_t i = 0; i < count; ++i) {
    Record<T>& node = reinterpret_cast<Record<T>*>(nodes)[i];
    const T mass = node[mass_slot];
    if (!(mass > T(0))) {
      node = Record<T>{T(0), T(0), T(0), mass};
      continue;
    }
    node = node / mass * keep;
    node[mass_slot] = mass;
  }
}

/// q <- p - q: the velocity change.
template <int D, class T>
void subtract_from(const T* p, T* q, std::size_t count) {
  for (std::size_t i = 0; i < count * node_values; i += node_values) {
    for (int a = 0; a < D; ++a) q[i + a] = p[i + a] - q[i + a];
  }
}

}  // namespace

template <int D, class T>
GridUpdate<D, T>::GridUpdate(const GridDomain<D>& domain, const Faces<D>& faces,
                             std::array<double, 3> lower, double cell_size)
    : domain_(domain), faces_(faces), lower_(lower), cell_size_(cell_size) {}

template <int D, class T>
void GridUpdate<D, T>::rebuild(const Grid<D, T>& grid) {
  pairs_ = find_face_pairs(grid, domain_);
  for (int a = 0; a < D; ++a) folded_[a].assign(pairs_[a].size(), 0);
}

template <int D, class T>
double GridUpdate<D, T>::apply(const Grid<D, T>& grid, AlignedVector<T>& channel_0,
                               AlignedVector<T>& channel_1, const GridForces& forces,
                               std::vector<Collider>& colliders, ThreadPool& pool) {
  T* p = channel_0.data();
  T* q = forces.separate_force ? channel_1.data() : nullptr;
  const double mass = add_forces(grid, p, q, forces, pool);
  fold(p, q, forces.separate_force);
  to_velocity(grid, p, q, forces, colliders, pool);
  unfold(p, q, forces.separate_force);
  return mass;
}

/// Afterwards p holds the momentum with all impulses; with separate forces q holds that without.
template <int D, class T>
double GridUpdate<D, T>::add_forces(const Grid<D, T>& grid, T* p, T* q, const GridForces& forces,
                                    ThreadPool& pool) {
  const int blocks = grid.topology().size();
  const std::size_t records = grid.block_values() / node_values;
  T kick[3] = {0, 0, 0};
  for (int a = 0; a < D; ++a) kick[a] = T(forces.dt * forces.gravity[a]);
  block_mass_.assign(std::size_t(blocks), 0.0);
  pool.for_each(
      blocks,
      [&](std::int64_t b, int) {
        if (q == nullptr) {
          T* first = p + std::size_t(b) * records * node_values;
          block_mass_[std::size_t(b)] = kick_nodes(first, records, kick);
          return;
        }
        double sum = 0;
        for (std::size_t i = std::size_t(b) * records; i < std::size_t(b + 1) * records; ++i) {
          T* node = p + i * node_values;
          const T mass = node[mass_slot];
          sum += mass;
          for (int a = 0; a < D; ++a) {
            const T before = node[a];
            node[a] += mass * kick[a];
            node[a] += q[i * node_values + a];
            q[i * node_values + a] = before;
          }
        }
        block_mass_[std::size_t(b)] = sum;
      },
      8);
  double total = 0;
  for (const double sum : block_mass_) total += sum;
  return total / grid.lattices();
}

/// Held walls come last: they act on the velocities that mirror planes and periodic faces have made
/// whole, so the result does not hang on the order of the axes.
template <int D, class T>
void GridUpdate<D, T>::fold(T* p, T* q, bool separate) {
  T* before = separate ? q : nullptr;
  for (const bool held : {false, true}) {
    for (int axis = 0; axis < D; ++axis) {
      for (std::size_t i = 0; i < pairs_[axis].size(); ++i) {
        const FacePair& pair = pairs_[axis][i];
        if ((faces_.type[axis][pair.side] == FaceType::sticky) != held) continue;
        const FaceType type = faces_.type[axis][pair.side];
        const T friction = T(faces_.friction[axis][pair.side]);
        const auto at = [](T* channel, std::int64_t record) {
          return channel == nullptr ? nullptr : channel + record * node_values;
        };
        if (pair.ghost == pair.image) {
          hold_wall_node<D>(type, friction, axis, pair.side, at(p, pair.image),
                            at(before, pair.image));
        } else {
          folded_[axis][i] =
              fold_ghost<D>(type, friction, axis, pair.side, at(p, pair.image), at(p, pair.ghost),
                            at(before, pair.image), at(before, pair.ghost));
        }
      }
    }
  }
}

template <int D, class T>
void GridUpdate<D, T>::fold_periodic(AlignedVector<T>& channel) const {
  for (int axis = 0; axis < D; ++axis) {
    for (const FacePair& pair : pairs_[axis]) {
      if (faces_.type[axis][pair.side] != FaceType::periodic) continue;
      move_to_image(channel.data() + pair.image * node_values,
                    channel.data() + pair.ghost * node_values);
    }
  }
}

template <int D, class T>
void GridUpdate<D, T>::unfold(T* p, T* q, bool separate) const {
  for (const bool held : {true, false}) {
    for (int axis = D - 1; axis >= 0; --axis) {
      for (std::size_t i = 0; i < pairs_[axis].size(); ++i) {
        const FacePair& pair = pairs_[axis][i];
        const FaceType type = faces_.type[axis][pair.side];
        if ((type == FaceType::sticky) != held) continue;
        if (folded_[axis][i] == 0 || pair.ghost == pair.image) continue;
        for (T* channel : {p, separate ? q : p}) {
          unfold_ghost<D>(type, axis, channel + pair.image * node_values,
                          channel + pair.ghost * node_values);
        }
      }
    }
  }
}

template <int D, class T>
void GridUpdate<D, T>::to_velocity(const Grid<D, T>& grid, T* p, T* q, const GridForces& forces,
                                   std::vector<Collider>& colliders, ThreadPool& pool) {
  const int blocks = grid.topology().size();
  block_reactions_.assign(std::size_t(blocks) * colliders.size(), Reaction{});
  pool.for_each(
      blocks, [&](std::int64_t b, int) { update_block(grid, b, p, q, forces, colliders); }, 8);
  reactions_.assign(colliders.size(), Reaction{});
  for (std::size_t i = 0; i < block_reactions_.size(); ++i) {
    Reaction& sum = reactions_[i % colliders.size()];
    for (int a = 0; a < 3; ++a) {
      sum.force[a] += block_reactions_[i].force[a] / (grid.lattices() * forces.dt);
      sum.torque[a] += block_reactions_[i].torque[a] / (grid.lattices() * forces.dt);
    }
  }
}

template <int D, class T>
void GridUpdate<D, T>::update_block(const Grid<D, T>& grid, std::int64_t block, T* p, T* q,
                                    const GridForces& forces, std::vector<Collider>& colliders) {
  const std::size_t records = grid.block_values() / node_values;
  const std::size_t first = std::size_t(block) * records * node_values;
  const T keep =
      forces.damping == DampingType::mass ? T(1 / (1 + forces.dt * forces.damping_value)) : T(1);
  const T local = forces.damping == DampingType::local ? T(forces.damping_value) : T(0);
  if (q != nullptr) {
    for (std::size_t i = first; i < first + records * node_values; i += node_values) {
      damp_node<D>(p + i, q + i, p[i + mass_slot], local);
    }
  }
  divide_by_mass(p + first, records, keep);
  if (!colliders.empty()) touch_block(grid, block, p + first, colliders);
  if (q != nullptr) subtract_from<D>(p + first, q + first, records);
}

template <int D, class T>
void GridUpdate<D, T>::touch_block(const Grid<D, T>& grid, std::int64_t block, T* nodes,
                                   std::vector<Collider>& colliders) {
  Reaction* reactions = &block_reactions_[std::size_t(block) * colliders.size()];
  for (int i = 0; i < grid.lattices() * block_node_count<D>; ++i) {
    T* record = nodes + i * node_values;
    if (!(record[mass_slot] > T(0))) continue;
    const int lattice = i / block_node_count<D>;
    const BlockCoord<D> node = grid.node(int(block), i % block_node_count<D>);
    std::array<double, 3> x = lower_;
    for (int a = 0; a < D; ++a) x[a] += cell_size_ * (node[a] + 0.5 * lattice);
    touch_colliders(x, record[mass_slot], record, colliders, reactions);
  }
}

template <int D, class T>
void GridUpdate<D, T>::touch_colliders(const std::array<double, 3>& x, T mass, T* v,
                                       std::vector<Collider>& colliders,
                                       Reaction* reactions) const {
  for (std::size_t c = 0; c < colliders.size(); ++c) {
    const Collider& collider = colliders[c];
    if (!collider.touches(x.data())) continue;
    const Vec3<double> old{{double(v[0]), double(v[1]), double(v[2])}};
    const Vec3<double> now =
        contact_velocity<double, D>(collider.contact(), collider.coefficient(), old,
                                    collider.velocity(), collider.normal(x.data()));
    Vec3<double> impulse{};
    Vec3<double> arm{};
    const Vec3<double> centre = collider.reference_point();
    for (int a = 0; a < D; ++a) {
      impulse[a] = double(mass) * (old[a] - now[a]);
      v[a] = T(now[a]);
    }
    for (int a = 0; a < 3; ++a) arm[a] = x[a] - centre[a];
    const Vec3<double> torque = cross(arm, impulse);
    for (int a = 0; a < 3; ++a) {
      reactions[c].force[a] += impulse[a];
      reactions[c].torque[a] += torque[a];
    }
  }
}

template class GridUpdate<2, float>;
template class GridUpdate<2, double>;
template class GridUpdate<3, float>;
template class GridUpdate<3, double>;

}  // namespace scree
