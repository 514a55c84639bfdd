// SPDX-License-Identifier: Apache-2.0
#include "solver/grid/grid_update.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/grid/face_fold.hpp"

namespace scree {

template <int D, class T>
GridUpdate<D, T>::GridUpdate(const GridDomain<D>& domain, const Faces<D>& faces,
                             std::array<double, 3> lower, double cell_size)
    : domain_(domain), faces_(faces), lower_(lower), cell_size_(cell_size) {}

template <int D, class T>
void GridUpdate<D, T>::rebuild(const Grid<D, T>& grid) {
  remember(grid.topology().keys());
  records_ = std::int64_t(grid.block_values()) / node_values;
  pairs_ = find_face_pairs(grid, domain_);
  for (int a = 0; a < D; ++a) {
    folded_[a].assign(pairs_[a].size(), pair_apart);
    runs_[a] = find_face_runs(pairs_[a], records_);
  }
  find_face_blocks(grid);
}

template <int D, class T>
void GridUpdate<D, T>::find_face_blocks(const Grid<D, T>& grid) {
  beside_face_.assign(std::size_t(grid.topology().size()), 0);
  for (const auto& axis : pairs_) {
    for (const FacePair& pair : axis) {
      beside_face_[std::size_t(pair.ghost / records_)] = 1;
      beside_face_[std::size_t(pair.image / records_)] = 1;
    }
  }
  face_blocks_.clear();
  for (std::size_t b = 0; b < beside_face_.size(); ++b) {
    if (beside_face_[b] != 0) face_blocks_.push_back(std::int64_t(b));
  }
}

/// Blocks that stay keep their memory; both lists of keys are sorted.
template <int D, class T>
void GridUpdate<D, T>::remember(const std::vector<std::uint64_t>& keys) {
  std::vector<std::vector<BlockContactMemory>> memory(keys.size());
  for (std::size_t now = 0, before = 0; now < keys.size(); ++now) {
    while (before < remembered_.size() && remembered_[before] < keys[now]) ++before;
    if (before < remembered_.size() && remembered_[before] == keys[now])
      memory[now] = std::move(memory_[before]);
  }
  memory_ = std::move(memory);
  remembered_ = keys;
}

template <int D, class T>
double GridUpdate<D, T>::apply(const Grid<D, T>& grid, AlignedVector<T>& channel_0,
                               AlignedVector<T>& channel_1, const GridForces& forces,
                               std::vector<Collider>& colliders, ThreadPool& pool) {
  T* p = channel_0.data();
  T* q = forces.separate_force ? channel_1.data() : nullptr;
  block_mass_.resize(std::size_t(grid.topology().size()));
  // Faces act between the two parts of the update; nodes far from them go through both at once.
  pool.for_each(
      std::int64_t(face_blocks_.size()),
      [&](std::int64_t i, int) { add_forces(grid, face_blocks_[std::size_t(i)], p, q, forces); },
      8);
  fold(p, q, forces.separate_force);
  to_velocity(grid, p, q, forces, colliders, pool);
  unfold(p, q, forces.separate_force);
  double mass = 0;
  for (const double sum : block_mass_) mass += sum;
  return mass / grid.lattices();
}

/// Afterwards p holds the momentum with all impulses; with separate forces q holds that without.
template <int D, class T>
void GridUpdate<D, T>::add_forces(const Grid<D, T>& grid, std::int64_t block, T* p, T* q,
                                  const GridForces& forces) {
  const std::size_t values = grid.block_values(), first = std::size_t(block) * values;
  T kick[3] = {0, 0, 0};
  for (int a = 0; a < D; ++a) kick[a] = T(forces.dt * forces.gravity[a]);
  double& sum = block_mass_[std::size_t(block)];
  if (q == nullptr) {
    sum = kick_nodes(p + first, values / node_values, kick);
    return;
  }
  sum = 0;
  for (std::size_t i = first; i < first + values; i += node_values) {
    const T mass = p[i + mass_slot];
    sum += mass;
    for (int a = 0; a < D; ++a) {
      const T before = p[i + a];
      p[i + a] += mass * kick[a];
      p[i + a] += q[i + a];
      q[i + a] = before;
    }
  }
}

/// Blocks without mass, which lie around every body, have nothing to fold. (Not so with periodic
/// faces: what lay beyond them binning has moved to the images, and it is still read there.)
template <int D, class T>
void GridUpdate<D, T>::fold(T* p, T* q, bool separate) {
  bool periodic = false;
  for (const auto& axis : faces_.type) periodic = periodic || axis[0] == FaceType::periodic;
  occupied_.assign(block_mass_.size(), 0);
  for (const std::int64_t b : face_blocks_) {
    occupied_[std::size_t(b)] = periodic || block_mass_[std::size_t(b)] > 0;
  }
  for (int stage = 0; stage < fold_stages; ++stage) {
    for (int axis = 0; axis < D; ++axis) {
      for (const FaceRun& run : runs_[axis]) {
        if (fold_stage(faces_.type[axis][run.side], faces_.no_slip) != stage) continue;
        if (occupied_[std::size_t(run.block)] != 0) {
          fold_run(axis, run, p, separate ? q : nullptr);
        } else {
          std::fill_n(folded_[axis].begin() + std::ptrdiff_t(run.begin), run.end - run.begin,
                      char(pair_apart));
        }
      }
    }
  }
}

template <int D, class T>
void GridUpdate<D, T>::fold_run(int axis, const FaceRun& run, T* p, T* before) {
  for (std::size_t i = run.begin; i < run.end; ++i) {
    const FacePair& pair = pairs_[axis][i];
    if (pair.ghost == pair.image) {
      hold_wall(pair, axis, p, before);
    } else {
      folded_[axis][i] = fold_pair_of_nodes(pair, axis, p, before);
      occupied_[std::size_t(pair.image / records_)] = 1;
    }
  }
}

/// A node on a wall. `before` (may be null): momenta before forces.
template <int D, class T>
void GridUpdate<D, T>::hold_wall(const FacePair& pair, int axis, T* p, T* before) const {
  const std::int64_t image = pair.image * node_values;
  hold_wall_node<D>(faces_.type[axis][pair.side], T(faces_.friction[axis][pair.side]), axis,
                    pair.side, p + image, before == nullptr ? nullptr : before + image);
}

/// A ghost and its image; a PairState.
template <int D, class T>
char GridUpdate<D, T>::fold_pair_of_nodes(const FacePair& pair, int axis, T* p, T* before) const {
  const std::int64_t image = pair.image * node_values;
  const std::int64_t ghost = pair.ghost * node_values;
  return char(fold_ghost<D>(faces_.type[axis][pair.side], faces_.no_slip,
                            T(faces_.friction[axis][pair.side]), axis, pair.side, p + image,
                            p + ghost, before == nullptr ? nullptr : before + image,
                            before == nullptr ? nullptr : before + ghost));
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
void GridUpdate<D, T>::move_periodic(std::vector<double>& masses) const {
  const auto each_pair = [this](int axis, auto&& f) {
    if (faces_.type[axis][0] != FaceType::periodic) return;  // then both faces are
    for (const FacePair& pair : pairs_[axis]) f(std::size_t(pair.ghost), std::size_t(pair.image));
  };
  for (int axis = 0; axis < D; ++axis) {
    each_pair(axis, [&](std::size_t ghost, std::size_t image) {
      masses[image] += masses[ghost];
      masses[ghost] = 0;
    });
  }
  constexpr double trace = std::numeric_limits<double>::min();  // adds nothing to a mass
  for (int axis = D - 1; axis >= 0; --axis) {
    each_pair(axis, [&](std::size_t ghost, std::size_t image) {
      if (masses[image] > 0) masses[ghost] = trace;
    });
  }
}

template <int D, class T>
void GridUpdate<D, T>::unfold(T* p, T* q, bool separate) const {
  for (int stage = fold_stages - 1; stage >= 0; --stage) {
    for (int axis = D - 1; axis >= 0; --axis) {
      for (const FaceRun& run : runs_[axis]) {
        const FaceType type = faces_.type[axis][run.side];
        if (fold_stage(type, faces_.no_slip) != stage) continue;
        if (occupied_[std::size_t(run.block)] == 0) continue;
        for (std::size_t i = run.begin; i < run.end; ++i) {
          const FacePair& pair = pairs_[axis][i];
          if (folded_[axis][i] != pair_follows || pair.ghost == pair.image) continue;
          for (T* channel : {p, separate ? q : p}) {
            unfold_ghost<D>(type, faces_.no_slip, axis, channel + pair.image * node_values,
                            channel + pair.ghost * node_values);
          }
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
      blocks,
      [&](std::int64_t b, int) {
        if (beside_face_[std::size_t(b)] == 0) add_forces(grid, b, p, q, forces);
        update_block(grid, b, p, q, forces, colliders);
      },
      8);
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
void GridUpdate<D, T>::add_reactions(const std::vector<Reaction>& more) {
  for (std::size_t i = 0; i < more.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      reactions_[i].force[a] += more[i].force[a];
      reactions_[i].torque[a] += more[i].torque[a];
    }
  }
}

template <int D, class T>
void GridUpdate<D, T>::update_block(const Grid<D, T>& grid, std::int64_t block, T* p, T* q,
                                    const GridForces& forces, std::vector<Collider>& colliders) {
  const std::size_t records = grid.block_values() / node_values;
  const std::size_t first = std::size_t(block) * records * node_values;
  const T keep = T(forces.kept()), local = T(forces.opposed());
  divide_by_mass(p + first, records, keep);
  if (q != nullptr) divide_by_mass_of<D>(p + first, q + first, records);
  // (m v - m v_old)/dt = f + R - m value v: R stops what the damping has left of v, and 1/keep of
  // it.
  if (!colliders.empty() || local > T(0))
    touch_block(grid, block, p + first, q == nullptr ? nullptr : q + first, local, keep, colliders);
  if (q != nullptr) subtract_from<D>(p + first, q + first, records);
}

template <int D, class T>
std::array<double, 3> GridUpdate<D, T>::position(const Grid<D, T>& grid, std::int64_t block,
                                                 int i) const {
  const int lattice = i / block_node_count<D>;
  const BlockCoord<D> node = grid.node(int(block), i % block_node_count<D>);
  std::array<double, 3> x = lower_;
  for (int a = 0; a < D; ++a) x[a] += cell_size_ * (node[a] + 0.5 * lattice);
  return x;
}

/// Local damping comes after the colliders, whose reaction is part of the unbalanced force.
template <int D, class T>
void GridUpdate<D, T>::touch_block(const Grid<D, T>& grid, std::int64_t block, T* nodes,
                                   const T* before, T local, T keep,
                                   const std::vector<Collider>& colliders) {
  Reaction* reactions = block_reactions_.data() + std::size_t(block) * colliders.size();
  std::vector<BlockContactMemory>& memory = memory_[std::size_t(block)];
  memory.resize(colliders.size());
  bool any_near = false;
  for (std::size_t c = 0; c < colliders.size(); ++c) {
    memory[c].near = near_block(grid, block, colliders[c], memory[c]);
    any_near = any_near || memory[c].near;
  }
  if (!any_near && !(local > T(0))) return;
  std::vector<HeldDirection> held;
  for (int i = 0; i < grid.lattices() * block_node_count<D>; ++i) {
    T* record = nodes + i * node_values;
    if (!(record[mass_slot] > T(0))) continue;
    held.clear();
    if (any_near) {
      touch_node(position(grid, block, i), i, double(record[mass_slot]) / double(keep), record,
                 colliders, memory, reactions, held);
    }
    if (local > T(0)) damp_node<D>(record, before + i * node_values, local, held);
  }
}

/// False if no node of the block can touch the collider.
template <int D, class T>
bool GridUpdate<D, T>::near_block(const Grid<D, T>& grid, std::int64_t block,
                                  const Collider& collider, BlockContactMemory& memory) const {
  if (!collider.costly()) return true;
  // Its nodes lie within [0, 3] cells, with the second lattice within [0, 3.5].
  const double half = 0.5 * cell_size_ * (block_cells - 1 + 0.5 * (grid.lattices() - 1));
  const BlockCoord<D> first = grid.node(int(block), 0);
  std::array<double, 3> center = lower_;
  for (int a = 0; a < D; ++a) center[std::size_t(a)] += cell_size_ * first[a] + half;
  if (collider.clear_of(center.data(), half * std::sqrt(double(D)), memory.center)) return false;
  if (memory.nodes.empty()) memory.nodes.resize(std::size_t(grid.lattices()) * block_node_count<D>);
  return true;
}

/// Contact of the block's node i (mass [kg], velocity v) at x with all colliders near the block.
template <int D, class T>
void GridUpdate<D, T>::touch_node(const std::array<double, 3>& x, int i, double mass, T* v,
                                  const std::vector<Collider>& colliders,
                                  std::vector<BlockContactMemory>& memory, Reaction* reactions,
                                  std::vector<HeldDirection>& held) const {
  for (std::size_t c = 0; c < colliders.size(); ++c) {
    const Collider& collider = colliders[c];
    if (!memory[c].near) continue;
    Vec3<double> normal;
    if (memory[c].nodes.empty()) {
      if (!collider.touches(x.data())) continue;
      normal = collider.normal(x.data());
    } else if (!collider.touches(x.data(), memory[c].nodes[std::size_t(i)], normal)) {
      continue;
    }
    Vec3<double> impulse{};
    Vec3<double> arm{};
    const Vec3<double> centre = collider.reference_point();
    const Vec3<double> place = collider.unwrapped(x.data());
    const bool holds = touch_surface<D>(collider.contact(), collider.coefficient(),
                                        collider.velocity(), normal, mass, v, impulse);
    if (holds) held.push_back({collider.contact() == ContactType::sticky, normal});
    for (int a = 0; a < 3; ++a) arm[a] = place[a] - centre[a];
    const Vec3<double> torque = cross(arm, impulse);
    for (int a = 0; a < 3; ++a) {
      reactions[c].force[std::size_t(a)] += impulse[a];
      reactions[c].torque[std::size_t(a)] += torque[a];
    }
  }
}

template class GridUpdate<2, float>;
template class GridUpdate<2, double>;
template class GridUpdate<3, float>;
template class GridUpdate<3, double>;

}  // namespace scree
