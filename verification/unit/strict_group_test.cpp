// SPDX-License-Identifier: Apache-2.0
//
// The strict group must find each defect that a GPU would suffer from.
#include "solver/exec/strict_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "solver/step/particle_ops.hpp"
#include "solver/transfer/compact.hpp"
#include "verification/support/block_scene.hpp"

namespace scree::testing {
namespace {

using Strict = StrictGroup<2, double, Compact>;
using V = Strict::V;
using Batch = Strict::Batch;
using Point = Compact::Point<V, 2>;

/// 43 particles: full batches and one that is not.
struct Defects : ::testing::Test {
  BlockScene<2, double> scene{Compact::lattices, {43}, 7};
  PassData<2, double> data = scene.data();

  /// What the strict group says about a body; empty if it has no objection.
  template <class Body>
  std::string verdict(Body&& body) {
    try {
      scene.run<Strict>(data, body);
    } catch (const std::logic_error& defect) {
      return defect.what();
    }
    return "";
  }
  template <class Body>
  void expect_defect(const std::string& words, Body&& body) {
    const std::string found = verdict(body);
    EXPECT_NE(found.find(words), std::string::npos) << "found: " << found;
  }
};

/// A number that the compiler cannot see, or it would itself complain about the wrong channel.
int opaque(int number) {
  volatile int hidden = number;
  return hidden;
}

Point point_of(const Strict& g, const Batch& b) {
  V u[2];
  load_position(g, b, u);
  return Compact::at<V, 2>(u);
}

void gather(const Strict& g, const Point& p, int channel = 0) {
  V value[2];
  V moment[2][2];
  g.gather_moments(channel, p.stencil.base[0], p.stencil.weight[0], value, moment);
}

void scatter(Strict& g, const Point& p, const V& mask, int channel = 0) {
  const V one = broadcast<V>(1);
  const V q[2] = {one, one};
  const V m[2][2] = {{one, one}, {one, one}};
  g.scatter_moments(channel, p.stencil.base[0], p.stencil.weight[0], q, one, m, mask);
}

void gather_all(Strict& g, int channel = 0) {
  g.each_batch([&](const Batch& b) { gather(g, point_of(g, b), channel); });
}

void scatter_all(Strict& g, int channel = 0) {
  g.each_batch([&](const Batch& b) { scatter(g, point_of(g, b), live_lanes<V>(g, b), channel); });
}

TEST_F(Defects, NoneInBodiesThatFollowTheRules) {
  EXPECT_EQ(verdict([](Strict& g) {
              g.stage_in(0);
              g.clear(0);
              g.clear(1);
              g.sync();
              gather_all(g);
              scatter_all(g);
              scatter_all(g, 1);
              g.sync();
              g.stage_out(0);
              g.stage_out(1);
            }),
            "");
}

TEST_F(Defects, MissingBarrierBeforeGather) {
  expect_defect("barrier is missing between stage_in and gather", [](Strict& g) {
    g.stage_in(0);
    gather_all(g);
  });
}

TEST_F(Defects, MissingBarrierAfterGather) {
  expect_defect("barrier is missing between gather and stage_in", [](Strict& g) {
    g.stage_in(0);
    g.sync();
    gather_all(g);
    g.stage_in(0);
  });
}

TEST_F(Defects, MissingBarrierBeforeScatter) {
  expect_defect("barrier is missing between clear and scatter", [](Strict& g) {
    g.clear(0);
    scatter_all(g);
    g.sync();
    g.stage_out(0);
  });
}

TEST_F(Defects, MissingBarrierAfterScatter) {
  expect_defect("barrier is missing between scatter and stage_out", [](Strict& g) {
    g.clear(0);
    g.sync();
    scatter_all(g);
    g.stage_out(0);
  });
}

TEST_F(Defects, MissingBarrierAroundTheGridAccess) {
  expect_defect("barrier is missing between clear and stage_out", [](Strict& g) {
    g.clear(0);
    g.stage_out(0);
  });
  expect_defect("barrier is missing between stage_out and clear", [](Strict& g) {
    g.clear(0);
    g.sync();
    g.stage_out(0);
    g.clear(0);
  });
  expect_defect("barrier is missing between scatter and clear", [](Strict& g) {
    g.clear(0);
    g.sync();
    scatter_all(g);
    g.clear(0);
  });
}

TEST_F(Defects, UninitialisedRead) {
  expect_defect("gathers velocities never staged in", [](Strict& g) {
    g.stage_in(1);
    g.sync();
    gather_all(g, 0);
  });
  expect_defect("scatters to sums never cleared", [](Strict& g) { scatter_all(g); });
  expect_defect("writes sums that were never cleared", [](Strict& g) { g.stage_out(0); });
}

TEST_F(Defects, SumsLostOrCountedTwice) {
  const auto scattered = [](Strict& g) {
    g.clear(0);
    g.sync();
    scatter_all(g);
    g.sync();
  };
  expect_defect("ends with sums that were not written", scattered);
  expect_defect("clears sums that were not written", [&](Strict& g) {
    scattered(g);
    g.clear(0);
  });
  expect_defect("writes the same sums twice", [&](Strict& g) {
    scattered(g);
    g.stage_out(0);
    g.sync();
    g.stage_out(0);
  });
  expect_defect("already written", [&](Strict& g) {
    scattered(g);
    g.stage_out(0);
    g.sync();
    scatter_all(g);
  });
}

TEST_F(Defects, ReadsAndWritesTheSameGrid) {
  data.write[0] = scene.read[0].data();
  expect_defect("reads and writes the same grid channel", [](Strict& g) {
    g.stage_in(0);
    g.clear(0);
    g.sync();
    g.stage_out(0);
  });
}

TEST_F(Defects, ChannelThatIsNotThere) {
  expect_defect("uses channel 2", [](Strict& g) { g.stage_in(opaque(2)); });
  expect_defect("uses channel -1", [](Strict& g) { g.clear(opaque(-1)); });
  data.read[1] = nullptr;
  data.write[1] = nullptr;
  expect_defect("does not read", [](Strict& g) { g.stage_in(1); });
  expect_defect("does not write", [](Strict& g) { g.stage_out(1); });
}

/// The arena of the compact kernel has nodes 0 .. 5 an axis; the stencil takes two.
TEST_F(Defects, NeighbourWithoutNodes) {
  const std::vector<std::int32_t> around(scene.grid.topology().neighbour_table().size(), -1);
  data.neighbours = around.data();
  expect_defect("neighbour that holds no nodes", [](Strict&) {});
}

TEST_F(Defects, StencilOutsideTheArena) {
  const auto gather_at = [](double x, double y) {
    return [x, y](Strict& g) {
      g.stage_in(0);
      g.sync();
      g.each_batch([&](const Batch&) {
        const V u[2] = {broadcast<V>(x), broadcast<V>(y)};
        gather(g, Compact::at<V, 2>(u));
      });
    };
  };
  EXPECT_EQ(verdict(gather_at(0.1, 4.9)), "");
  for (const double outside : {-0.1, 5.1, 60.0}) {
    expect_defect("leaves the arena", gather_at(outside, 2.0));
    expect_defect("leaves the arena", gather_at(2.0, outside));
  }
}

TEST_F(Defects, ScatterOfLanesWithoutParticles) {
  const auto scatter_with = [](double full, double rest) {
    return [full, rest](Strict& g) {
      g.clear(0);
      g.sync();
      g.each_batch([&](const Batch& b) {
        const V mask = select(g.active(b), broadcast<V>(full), broadcast<V>(rest));
        scatter(g, point_of(g, b), mask);
      });
      g.sync();
      g.stage_out(0);
    };
  };
  EXPECT_EQ(verdict(scatter_with(1, 0)), "");
  expect_defect("a lane without a particle", scatter_with(0, 1));
  expect_defect("neither 0 nor 1", scatter_with(0.5, 0));
}

TEST_F(Defects, ScatterOfRemovedParticles) {
  expect_defect("scatters a removed particle", [](Strict& g) {
    g.clear(0);
    g.sync();
    g.each_batch([&](const Batch& b) {
      g.remove(g.active(b), b);
      scatter(g, point_of(g, b), live_lanes<V>(g, b));
    });
  });
}

TEST_F(Defects, ReportsAboutLanesWithoutParticles) {
  const auto all = [](auto&& report) {
    return [report](Strict& g) {
      const auto every = broadcast<V>(0) < broadcast<V>(1);
      g.each_batch([&](const Batch& b) { report(g, every, b); });
    };
  };
  const V one = broadcast<V>(1);
  expect_defect("notes the motion of a lane without",
                all([=](Strict& g, auto m, const Batch&) { g.note_motion(m, one, one); }));
  expect_defect("notes the wave speed of a lane without",
                all([=](Strict& g, auto m, const Batch&) { g.note_signal(m, one); }));
  expect_defect("removes a lane without",
                all([](Strict& g, auto m, const Batch& b) { g.remove(m, b); }));
  expect_defect("reports a fault of a lane without", all([=](Strict& g, auto m, const Batch& b) {
                  const V u[2] = {one, one};
                  g.fault(m, FaultCode::not_finite, one, u, b);
                }));
}

TEST_F(Defects, FieldThatIsNotThere) {
  for (const int field : {-1, data.fields}) {
    const std::string number = std::to_string(field);
    expect_defect("reads particle field " + number, [&](Strict& g) {
      g.each_batch([&](const Batch& b) { (void)g.load(b, field); });
    });
    expect_defect("writes particle field " + number, [&](Strict& g) {
      g.each_batch([&](const Batch& b) { g.store(b, field, broadcast<V>(1)); });
    });
  }
  for (const int field : {-1, data.layout.total}) {
    const std::string number = std::to_string(field);
    expect_defect("reads aux field " + number, [&](Strict& g) {
      g.each_batch([&](const Batch& b) { (void)g.load_aux(b, field); });
    });
    expect_defect("writes aux field " + number, [&](Strict& g) {
      g.each_batch([&](const Batch& b) { g.store_aux(b, field, broadcast<V>(1)); });
    });
  }
}

TEST_F(Defects, BarrierThatSomeThreadsMiss) {
  const auto within = [](auto&& primitive) {
    return [primitive](Strict& g) { g.each_batch([&](const Batch&) { primitive(g); }); };
  };
  expect_defect("sync within each_batch", within([](Strict& g) { g.sync(); }));
  expect_defect("stage_in within each_batch", within([](Strict& g) { g.stage_in(0); }));
  expect_defect("clear within each_batch", within([](Strict& g) { g.clear(0); }));
  expect_defect("stage_out within each_batch", within([](Strict& g) { g.stage_out(0); }));
  expect_defect("each_batch within each_batch",
                within([](Strict& g) { g.each_batch([](const Batch&) {}); }));
}

TEST_F(Defects, BatchKeptBeyondItsVisit) {
  expect_defect("outside its visit", [](Strict& g) {
    std::optional<Batch> kept;
    g.each_batch([&](const Batch& b) {
      if (!kept) kept = b;
      (void)g.load(*kept, 0);
    });
  });
  expect_defect("outside its visit", [](Strict& g) {
    std::optional<Batch> kept;
    g.each_batch([&](const Batch& b) { kept = b; });
    (void)g.load(*kept, 0);
  });
}

TEST(StrictGroup, PoisonsTheArena) {
  BlockScene<2, double> scene(Compact::lattices, {1}, 7);
  const PassData<2, double> data = scene.data();
  AlignedVector<double> arena(Strict::arena_values, 1.0);
  Strict group(data, arena.data());
  group.begin(0);
  for (std::size_t i = 0; i < arena.size(); ++i) {
    // Bits, since an operation on a signalling NaN is what the poison is to trap.
    const std::uint64_t bits = std::uint64_t(to_bits(arena[i]));
    ASSERT_EQ(bits >> 51, 0x7ffu << 1) << "at " << i;      // exponent of a NaN, quiet bit not set
    ASSERT_NE(bits & ((std::uint64_t(1) << 51) - 1), 0u);  // not infinity
  }
}

/// First particle id of the batches of each block, in the order of visits.
std::vector<std::vector<std::int64_t>> visits(const std::vector<int>& counts) {
  BlockScene<2, double> scene(Compact::lattices, counts, 7);
  std::vector<std::vector<std::int64_t>> order;
  scene.run<Strict>(scene.data(), [&](Strict& g) {
    order.emplace_back();
    g.each_batch([&](const Batch& b) { order.back().push_back(b.id[0] / Strict::width); });
  });
  return order;
}

TEST(StrictGroup, ShufflesBatchesTheSameWayEveryTime) {
  const int batches = 30;  // the odds of an unshuffled order are 1 : 30!
  const std::vector<int> counts(2, batches * Strict::width);
  const auto order = visits(counts);
  ASSERT_EQ(order.size(), 2u);
  std::vector<std::int64_t> second;
  for (const std::int64_t b : order[1]) second.push_back(b - batches);
  for (const auto& block : {order[0], second}) {
    EXPECT_EQ(std::set<std::int64_t>(block.begin(), block.end()).size(), std::size_t(batches));
    EXPECT_EQ(block.size(), std::size_t(batches));
    EXPECT_FALSE(std::is_sorted(block.begin(), block.end()));
  }
  EXPECT_NE(order[0], second);  // blocks differ
  EXPECT_EQ(order, visits(counts));
}

}  // namespace
}  // namespace scree::testing
