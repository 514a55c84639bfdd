// SPDX-License-Identifier: Apache-2.0
//
// Random particles in a few blocks and random grids, to run block bodies on any group.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solver/exec/aligned.hpp"
#include "solver/grid/grid.hpp"
#include "solver/particles/store.hpp"
#include "solver/step/pass_data.hpp"
#include "verification/support/random.hpp"

namespace scree::testing {

/// Particles whose state is a deformation gradient and perhaps further entries, which are zero,
/// with every aux field; grid channels 0 and 1 to read (random) and to write (zero).
template <int D, class T>
struct BlockScene {
  static constexpr int fields = D + 9;
  static constexpr int width = ParticleStore<D, T>::width;

  /// counts: particles of the blocks (0, ..., 0, i), i = 0, 1, ...
  BlockScene(int lattices, const std::vector<int>& counts, unsigned long long seed,
             int further_entries = 0)
      : store(fields + further_entries, 2 * D + 2 * D * D + 6, padding(further_entries)),
        grid(lattices) {
    Random random(seed);
    layout = {0, D, D + D * D, D + D * D + 6, D + 2 * D * D + 6, 2 * D + 2 * D * D + 6};
    std::vector<std::uint64_t> keys;
    std::int64_t id = 0;
    for (int i = 0; i < int(counts.size()); ++i) {
      BlockCoord<D> c{};
      c[D - 1] = i;
      keys.push_back(block_key<D>(c));
      for (int p = 0; p < counts[std::size_t(i)]; ++p) add_particle(random, keys.back(), id++);
    }
    store.finish_blocks();
    GridDomain<D> domain;
    domain.lattices = lattices;
    grid.topology().build(keys, domain);
    for (int c = 0; c < 2; ++c) {
      read[c].resize(grid.size());
      for (T& v : read[c]) v = T(random.uniform(-1, 1));
      write[c].assign(grid.size(), T(0));
    }
    for (const auto& block : store.blocks()) {
      grid_block.push_back(grid.topology().find(block.key));
      for (const std::int32_t c : block_coord<D>(block.key)) coords.push_back(c);
    }
    results.resize(store.blocks().size());
  }

  PassData<D, T> data() {
    PassData<D, T> d;
    PassParameters<T>& par = d.parameters;
    par.dt = par.dt_next = T(0.05);  // cells of 1 m and speeds near 1 m/s: strays stay below 1/4
    par.particle_mass = T(0.7);
    par.particle_volume = T(0.1);
    par.derive();
    for (int a = 0; a < 3; ++a) {
      par.alive_lower[a] = par.closed_lower[a] = par.wrap_lower[a] = T(-1e30);
      par.alive_upper[a] = par.closed_upper[a] = par.wrap_upper[a] = T(1e30);
    }
    d.layout = layout;
    d.fields = store.fields();
    d.particles = store.batch(0);
    d.aux = store.aux_batch(0);
    d.ids = store.ids(0);
    d.batch_begin = store.batch_begin().data();
    d.batch_list = store.batch_list().data();
    d.counts = store.counts().data();
    d.grid_block = grid_block.data();
    d.coords = coords.data();
    d.neighbours = grid.topology().neighbour_table().data();
    for (int c = 0; c < 2; ++c) {
      d.read[c] = read[c].data();
      d.write[c] = write[c].data();
    }
    d.results = results.data();
    return d;
  }

  /// f(group) on every block, one after the other.
  template <class Group, class F>
  void run(const PassData<D, T>& d, F&& f) {
    AlignedVector<T> arena(Group::arena_values);
    for (int b = 0; b < int(store.blocks().size()); ++b) {
      Group group(d, arena.data());
      group.begin(b);
      f(group);
      group.finish();
    }
  }

  /// Values of one particle field or aux field by particle id.
  std::vector<T> field(int f, bool aux = false) {
    std::vector<T> values(std::size_t(store.count()), T(-99));
    for (const auto& block : store.blocks()) {
      for (int i = 0; i < block.count; ++i) {
        const std::int64_t slot =
            std::int64_t(block.batches[std::size_t(i / width)]) * width + i % width;
        const std::int64_t id = store.ids(0)[slot];
        values[std::size_t(id)] = aux ? store.aux_value(slot, f) : store.value(slot, f);
      }
    }
    return values;
  }

  ParticleStore<D, T> store;
  Grid<D, T> grid;
  AuxLayout layout;
  AlignedVector<T> read[2];
  AlignedVector<T> write[2];
  std::vector<std::int32_t> grid_block;
  std::vector<std::int32_t> coords;
  std::vector<BlockResult<T>> results;

 private:
  static std::vector<T> padding(int further_entries) {
    std::vector<T> values(std::size_t(fields + further_entries), T(0));
    for (int i = 0; i < 3; ++i) values[D + 4 * std::size_t(i)] = T(1);
    return values;
  }

  void add_particle(Random& random, std::uint64_t key, std::int64_t id) {
    const std::int64_t slot = store.append(key, id);
    for (int a = 0; a < D; ++a) store.value(slot, a) = T(random.uniform(home_begin, home_end));
    for (int i = 0; i < 9; ++i) {
      store.value(slot, D + i) = T((i % 4 == 0 ? 1 : 0) + random.uniform(-0.1, 0.1));
    }
    for (int f = 0; f < store.aux_fields(); ++f)
      store.aux_value(slot, f) = T(random.uniform(-0.1, 0.1));
  }
};

}  // namespace scree::testing
