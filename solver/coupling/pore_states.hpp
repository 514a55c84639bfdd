// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/base/pack.hpp"
#include "solver/base/tensor.hpp"
#include "solver/exec/aligned.hpp"

namespace scree {

/// Numbers of a particle's pores.
template <int D>
struct PoreRow {
  static constexpr int deformation = 0;          ///< D*D: F since t = 0
  static constexpr int ratio = D * D;            ///< J of the last points
  static constexpr int start_ratio = ratio + 1;  ///< J at t = 0
  static constexpr int pressure = ratio + 2;     ///< [Pa], the latest one looked at
  static constexpr int stored =
      ratio + 3;                          ///< volume that compression made room for [m^3], at base
  static constexpr int base = ratio + 4;  ///< pressure [Pa] at the start of the stride
  static constexpr int seepage = ratio + 5;  ///< D [m/s]
  static constexpr int count = seepage + D;
};

/// Pores of a vector of particles.
template <int D>
struct alignas(64) PoreVector {
  static constexpr int width = lanes_of<Lanes<double>>;
  double row[PoreRow<D>::count][width];
};

/// The pores of all particles, which stay with them, in the order of the bodies' stores: a step
/// goes through both side by side. A place is a slot of a body's store, behind those of the bodies
/// before it.
template <int D>
class PoreStates {
 public:
  using Row = PoreRow<D>;
  static constexpr int width = PoreVector<D>::width;

  /// particles: of all bodies; their pores are undeformed and have no place yet.
  explicit PoreStates(std::int64_t particles) { now_.place.assign(std::size_t(particles), -1); }

  /// Begins a new order; slots: of each body's store.
  void begin_order(const std::vector<std::int64_t>& slots);
  /// The slot of a particle in the store of its body.
  void put(int body, std::int64_t slot, std::int64_t id) {
    const std::int64_t to = coming_.first[std::size_t(body)] + slot;
    coming_.id[std::size_t(to)] = id;
    coming_.place[std::size_t(id)] = to;
  }
  /// Moves the pores, after gone(id) for each particle that has no place any more.
  template <class Gone>
  void end_order(Gone&& gone) {
    for (std::size_t id = 0; id < now_.place.size(); ++id) {
      if (now_.place[id] >= 0 && coming_.place[id] < 0) gone(std::int64_t(id));
    }
    move_pores();
  }

  /// The particle has left, which is known already.
  void forget(std::int64_t id) { now_.place[std::size_t(id)] = -1; }

  std::int64_t particles() const { return std::int64_t(now_.place.size()); }
  /// Where a particle is; -1: it has none.
  std::int64_t place(std::int64_t id) const { return now_.place[std::size_t(id)]; }
  /// The particle at a place; -1: none.
  std::int64_t id(std::int64_t place) const { return now_.id[std::size_t(place)]; }
  std::int64_t first_place(int body) const { return now_.first[std::size_t(body)]; }
  std::int64_t places() const { return std::int64_t(now_.id.size()); }

  PoreVector<D>& vector(std::int64_t place) { return now_.vectors[std::size_t(place / width)]; }
  const PoreVector<D>& vector(std::int64_t place) const {
    return now_.vectors[std::size_t(place / width)];
  }
  /// Asks memory for what a step changes of a vector.
  void prefetch(std::int64_t place) const {
    const auto& row = vector(place).row;
    for (int k = 0; k < Row::seepage; ++k) __builtin_prefetch(row[k], 0, 2);
  }
  /// The same of what the gained mass of water follows from.
  void prefetch_gain(std::int64_t place) const {
    const auto& row = vector(place).row;
    for (const int k : {Row::ratio, Row::start_ratio, Row::stored}) __builtin_prefetch(row[k]);
  }
  /// The same of what a pressure changes.
  void prefetch_pressure(std::int64_t place) const {
    const auto& row = vector(place).row;
    for (const int k : {Row::pressure, Row::stored, Row::base}) __builtin_prefetch(row[k], 1);
  }
  double& at(std::int64_t place, int row) { return vector(place).row[row][place % width]; }
  double at(std::int64_t place, int row) const { return vector(place).row[row][place % width]; }

  std::int64_t bytes() const {
    return std::int64_t(sizeof(PoreVector<D>) * now_.vectors.capacity() +
                        8 * (now_.id.capacity() + now_.place.capacity()));
  }

 private:
  struct Order {
    std::vector<std::int64_t> first;  ///< place of each body's first slot
    AlignedVector<PoreVector<D>> vectors;
    std::vector<std::int64_t> id;     ///< by place
    std::vector<std::int64_t> place;  ///< by id
  };

  void move_pores();

  Order now_, coming_;
};

extern template class PoreStates<2>;
extern template class PoreStates<3>;

}  // namespace scree
