// SPDX-License-Identifier: Apache-2.0
//
// Where particles with water are: their order in a block, the columns of blocks, their pores.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

#include "solver/coupling/flow_columns.hpp"
#include "solver/coupling/point_order.hpp"
#include "solver/coupling/pore_states.hpp"

namespace scree {
namespace {

constexpr int width = PointOrder<3>::width;

/// Points of block (1, 0, 2) with half a block of room on all sides.
struct Block {
  PressureLattice<3> lattice;
  PointOrder<3> order;
  FlowChunk<3> chunk;
  std::vector<std::array<double, 3>> u;  ///< cells from the block's corner

  Block(int spacing, double offset, int points)
      : lattice(spacing, offset, {16, 16, 16}, {}), order(lattice) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(home_begin - max_excursion,
                                                 home_end + max_excursion);
    for (int i = 0; i < points; ++i) u.push_back({place(random), place(random), place(random)});
    chunk.block = {1, 0, 2};
    chunk.end = points;
    order.resize(points);
  }

  bool note() {
    bool same = order.known();
    for (int first = 0; first < int(u.size()); first += width) {
      const int count = std::min(width, int(u.size()) - first);
      alignas(64) double position[3][width];
      for (int i = 0; i < width; ++i) {
        for (std::size_t a = 0; a < 3; ++a) {
          position[a][i] = i < count ? u[std::size_t(first + i)][a] : 1.0;
        }
      }
      same &= order.note(chunk, first, count, position);
    }
    return same;
  }
  void arrange() {
    if (!note()) order.arrange(chunk);
    order.finish();
  }
  /// From the domain's corner [cells].
  double place(std::size_t i, std::size_t axis) const {
    return block_cells * chunk.block[axis] + u[i][axis];
  }
};

TEST(PointOrder, PointsOfACellAndOfAHalfCellFollowEachOther) {
  for (const auto& [spacing, offset] : {std::pair{2, 0.0}, {1, 0.25}, {2, 0.5}}) {
    Block block(spacing, offset, 1000);
    block.arrange();
    std::vector<std::size_t> point(block.u.size(), block.u.size());
    for (std::size_t i = 0; i < block.u.size(); ++i) {
      point.at(std::size_t(block.order.place(block.chunk, int(i)))) = i;
    }
    std::int64_t next = 0;
    std::set<PressureNode<3>> cells;
    for (const FlowRun<3>& run : block.chunk.runs) {
      EXPECT_EQ(run.begin, next);
      next = run.end;
      EXPECT_TRUE(cells.insert(run.cell).second);
      std::set<std::array<int, 3>> halves;
      std::array<int, 3> last{};
      for (std::int64_t p = run.begin; p < run.end; ++p) {
        const std::size_t i = point.at(std::size_t(p));
        ASSERT_LT(i, block.u.size());  // no two points at one place
        std::array<int, 3> half{};
        for (std::size_t a = 0; a < 3; ++a) {
          EXPECT_EQ(run.cell[a], int(std::floor((block.place(i, a) - offset) / spacing)));
          half[a] = int(std::floor(2 * block.place(i, a)));
        }
        if (p == run.begin || half != last) {
          EXPECT_TRUE(halves.insert(half).second);
        }
        last = half;
      }
    }
    EXPECT_EQ(next, std::int64_t(block.u.size()));
  }
}

TEST(PointOrder, IsKeptWhileNoPointLeavesItsHalfCell) {
  Block block(2, 0.0, 100);
  block.u[50] = {1.2, 1.2, 1.2};
  block.arrange();
  EXPECT_TRUE(block.note());
  block.u[50][1] = 1.4;
  EXPECT_TRUE(block.note());
  block.u[50][1] = 1.6;
  EXPECT_FALSE(block.note());
  block.arrange();
  block.order.forget();  // other particles
  EXPECT_FALSE(block.note());
}

TEST(FlowColumns, OfOneColourAreTwoBlocksApartAndInOrder) {
  std::vector<FlowChunk<3>> chunks;
  for (int i = 0; i < 5 * 4 * 3; ++i) {
    FlowChunk<3> chunk;
    chunk.block = {i % 5, i / 5 % 4, 2 - i / 20};
    chunk.body = i % 7 == 6 ? 1 : 0;
    chunks.push_back(chunk);
  }
  const FlowColumns<3> columns(chunks, 0, {20, 16, 12}, {}, false);
  EXPECT_TRUE(columns.alone.empty());
  std::set<std::int32_t> seen;
  for (const auto& of_colour : columns.colours) {
    for (const auto& column : of_colour) {
      const auto& first = chunks[std::size_t(column.front())].block;
      for (std::size_t k = 0; k < column.size(); ++k) {
        EXPECT_TRUE(seen.insert(column[k]).second);
        const auto& at = chunks[std::size_t(column[k])].block;
        EXPECT_TRUE(at[0] == first[0] && at[1] == first[1]);
        if (k > 0) {
          EXPECT_GT(at[2], chunks[std::size_t(column[k - 1])].block[2]);
        }
      }
      for (const auto& other : of_colour) {
        const auto& far = chunks[std::size_t(other.front())].block;
        EXPECT_EQ((far[0] - first[0]) % 2, 0);
        EXPECT_EQ((far[1] - first[1]) % 2, 0);
      }
    }
  }
  EXPECT_EQ(seen.size(), std::size_t(std::count_if(chunks.begin(), chunks.end(),
                                                   [](const auto& c) { return c.body == 0; })));
}

TEST(FlowColumns, BesidePeriodicFacesAreAlone) {
  std::vector<FlowChunk<2>> chunks;
  for (int i = 0; i < 25; ++i) {
    FlowChunk<2> chunk;
    chunk.block = {i / 5, i % 5};
    chunks.push_back(chunk);
  }
  const FlowColumns<2> columns(chunks, 0, {18, 20}, {true, false}, false);
  std::set<int> alone;
  for (const auto& column : columns.alone) {
    alone.insert(chunks[std::size_t(column.front())].block[0]);
  }
  EXPECT_EQ(alone, (std::set<int>{0, 4}));  // the last block has half a block of cells
  EXPECT_EQ(columns.colours[0].size() + columns.colours[1].size(), 3U);
  const FlowColumns<2> all(chunks, 0, {18, 20}, {}, true);
  EXPECT_EQ(all.alone.size(), 5U);
}

TEST(PoreStates, PoresFollowTheirParticles) {
  using Row = PoreRow<2>;
  PoreStates<2> states(5);
  const auto order = [&](const std::vector<std::pair<int, std::int64_t>>& places) {
    states.begin_order({10, 3});
    for (std::size_t id = 0; id < places.size(); ++id) {
      if (places[id].first >= 0) states.put(places[id].first, places[id].second, std::int64_t(id));
    }
    std::vector<std::int64_t> gone;
    states.end_order([&](std::int64_t id) { gone.push_back(id); });
    return gone;
  };
  EXPECT_TRUE(order({{0, 0}, {0, 9}, {1, 0}, {1, 2}, {-1, 0}}).empty());
  EXPECT_EQ(states.first_place(1) % PoreStates<2>::width, 0);  // whole vectors
  EXPECT_EQ(states.place(4), -1);
  for (std::int64_t id = 0; id < 4; ++id) {
    const std::int64_t place = states.place(id);
    EXPECT_EQ(states.id(place), id);
    EXPECT_EQ(states.at(place, Row::ratio), 1.0);
    EXPECT_EQ(states.at(place, Row::deformation + 3), 1.0);
    EXPECT_EQ(states.at(place, Row::deformation + 1), 0.0);
    for (int k = 0; k < Row::count; ++k) states.at(place, k) = 100.0 * double(id) + k;
  }
  states.forget(1);
  EXPECT_EQ(order({{0, 3}, {-1, 0}, {1, 1}, {-1, 0}, {-1, 0}}), (std::vector<std::int64_t>{3}));
  for (const std::int64_t id : {0, 2}) {
    for (int k = 0; k < Row::count; ++k) {
      EXPECT_EQ(states.at(states.place(id), k), 100.0 * double(id) + k);
    }
  }
  EXPECT_EQ(states.place(3), -1);
}

}  // namespace
}  // namespace scree
