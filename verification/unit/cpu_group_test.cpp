// SPDX-License-Identifier: Apache-2.0
//
// The primitives of CpuGroup against plain sums over the grid's nodes, particle by particle.
#include "solver/exec/cpu_group.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"
#include "verification/support/block_scene.hpp"

namespace scree::testing {
namespace {

template <int Dimension, class Real, class KernelType>
struct Case {
  static constexpr int D = Dimension;
  using T = Real;
  using Kernel = KernelType;
};
using Cases =
    ::testing::Types<Case<2, double, Compact>, Case<2, float, Compact>, Case<3, double, Compact>,
                     Case<3, float, Compact>, Case<2, float, Quadratic>, Case<3, double, Quadratic>,
                     Case<3, double, Linear>, Case<2, float, Linear>>;

/// Lattice number of the lowest node of a particle's stencil, u in cells.
int lowest_node(const Compact&, int lattice, double u) {
  return int(std::floor(u - 0.5 * lattice));  // lattice 1 has its nodes at i + 1/2
}
int lowest_node(const Quadratic&, int, double u) { return int(std::floor(u - 0.5)); }
int lowest_node(const Linear&, int, double u) { return int(std::floor(u)); }

template <class C>
struct CpuGroupTest : ::testing::Test {
  static constexpr int D = C::D;
  static constexpr int S = C::Kernel::support;
  using T = typename C::T;
  using Kernel = typename C::Kernel;
  using Group = CpuGroup<D, T, Kernel>;
  using V = typename Group::V;
  using Batch = typename Group::Batch;
  using Point = typename Kernel::template Point<V, D>;

  BlockScene<D, T> scene{Kernel::lattices, {61, 0, 5, 200}, 3};
  PassData<D, T> data = scene.data();
  // Sums of up to 27 products, or of up to about 100 particles, of size 1.
  const double tolerance = 200 * double(std::numeric_limits<T>::epsilon());

  static Point point_of(const Group& g, const Batch& b, V (&u)[D]) {
    for (int a = 0; a < D; ++a) u[a] = g.load(b, a);
    return Kernel::template at<V, D>(u);
  }

  /// f(record, product of w, products with the weight of one axis replaced by alt) for each node of
  /// lane l's stencil; the records are found from the particle's place in the domain.
  template <class F>
  void each_node(int block, int k, int l, const V (&u)[D], const V (&w)[D][S], const V (&alt)[D][S],
                 F&& f) {
    for (int s = 0; s < power(S, D); ++s) {
      BlockCoord<D> node{};
      double product[1 + D];
      for (double& x : product) x = 1;
      for (int a = D - 1, rest = s; a >= 0; --a, rest /= S) {
        const int n = rest % S;
        const double x =
            double(lane(u[a], l)) + block_cells * scene.coords[std::size_t(block * D + a)];
        node[std::size_t(a)] = lowest_node(Kernel{}, k, x) + n;
        for (int p = 0; p <= D; ++p) {
          product[p] *= double(lane(p == a + 1 ? alt[a][n] : w[a][n], l));
        }
      }
      f(std::size_t(scene.grid.record(node, k)) * node_values, product);
    }
  }

  /// Any numbers as the second set of weights: derivatives need not be those of the weights.
  static void some_slopes(const Point& p, int k, V (&slope)[D][S]) {
    for (int a = 0; a < D; ++a) {
      for (int s = 0; s < S; ++s) {
        slope[a][s] = T(0.5) * p.stencil.weight[k][a][(s + 1) % S] - T(0.25 * (a + 1));
      }
    }
  }
  static void numbered(const Point& p, int k, V (&alt)[D][S]) {
    for (int a = 0; a < D; ++a) {
      for (int s = 0; s < S; ++s) alt[a][s] = T(s) * p.stencil.weight[k][a][s];
    }
  }

  void expect_gather(int block, int channel, int k, const Batch& b, const V (&u)[D],
                     const V (&w)[D][S], const V (&alt)[D][S], const V (&value)[D],
                     const V (&moment)[D][D]) {
    for (int l = 0; l < b.active; ++l) {
      double sums[1 + D][D] = {};
      each_node(block, k, l, u, w, alt, [&](std::size_t record, const double(&product)[1 + D]) {
        for (int p = 0; p <= D; ++p) {
          for (int c = 0; c < D; ++c) {
            sums[p][c] += product[p] * double(scene.read[channel][record + std::size_t(c)]);
          }
        }
      });
      for (int c = 0; c < D; ++c) {
        ASSERT_NEAR(lane(value[c], l), sums[0][c], tolerance);
        for (int a = 0; a < D; ++a) ASSERT_NEAR(lane(moment[c][a], l), sums[1 + a][c], tolerance);
      }
    }
  }

  void gather_batch(Group& g, int block, const Batch& b) {
    V u[D];
    const Point p = point_of(g, b, u);
    for (int k = 0; k < Kernel::lattices; ++k) {
      V value[D];
      V moment[D][D];
      V alt[D][S];
      numbered(p, k, alt);
      g.gather_moments(0, p.stencil.base[k], p.stencil.weight[k], value, moment);
      expect_gather(block, 0, k, b, u, p.stencil.weight[k], alt, value, moment);
      some_slopes(p, k, alt);
      g.gather_slopes(1, p.stencil.base[k], p.stencil.weight[k], alt, value, moment);
      expect_gather(block, 1, k, b, u, p.stencil.weight[k], alt, value, moment);
    }
  }

  /// Scatters by both primitives and adds the same to `expected`, all lanes but every third.
  void scatter_batch(Group& g, int block, const Batch& b, std::vector<double> (&expected)[2]) {
    V u[D];
    const Point p = point_of(g, b, u);
    V q[D];
    V m[D][D];
    for (int c = 0; c < D; ++c) {
      q[c] = g.load_aux(b, c);
      for (int a = 0; a < D; ++a) m[c][a] = g.load_aux(b, D + c * D + a);
    }
    const V mass = g.load(b, D) * T(0.5);
    V mask = select(g.active(b), broadcast<V>(T(1)), broadcast<V>(T(0)));
    for (int l = 0; l < Group::width; l += 3) set_lane(mask, l, T(0));
    for (int k = 0; k < Kernel::lattices; ++k) {
      const auto& w = p.stencil.weight[k];
      V alt[2][D][S];
      numbered(p, k, alt[0]);
      some_slopes(p, k, alt[1]);
      g.scatter_moments(0, p.stencil.base[k], w, q, mass, m, mask);
      g.scatter_slopes(1, p.stencil.base[k], w, alt[1], q, mass, m, mask);
      for (int l = 0; l < b.active; ++l) {
        for (int i = 0; i < 2 && l % 3 != 0; ++i) {
          each_node(block, k, l, u, w, alt[i],
                    [&](std::size_t record, const double(&product)[1 + D]) {
                      for (int c = 0; c < D; ++c) {
                        double sum = product[0] * double(lane(q[c], l));
                        for (int a = 0; a < D; ++a)
                          sum += product[1 + a] * double(lane(m[c][a], l));
                        expected[i][record + std::size_t(c)] += sum;
                      }
                      expected[i][record + mass_slot] += product[0] * double(lane(mass, l));
                    });
        }
      }
    }
  }
};
TYPED_TEST_SUITE(CpuGroupTest, Cases);

TYPED_TEST(CpuGroupTest, GathersWhatTheNodesHold) {
  using Group = typename TestFixture::Group;
  int block = 0;
  std::int64_t particles = 0;
  this->scene.template run<Group>(this->data, [&](Group& g) {
    g.stage_in(0);
    g.stage_in(1);
    g.sync();
    g.each_batch([&](const typename Group::Batch& b) {
      particles += b.active;
      this->gather_batch(g, block, b);
    });
    ++block;
  });
  EXPECT_EQ(particles, this->scene.store.count());
}

TYPED_TEST(CpuGroupTest, ScattersToTheNodesOfLiveLanes) {
  using Group = typename TestFixture::Group;
  std::vector<double> expected[2];
  for (auto& e : expected) e.assign(this->scene.grid.size(), 0.0);
  int block = 0;
  this->scene.template run<Group>(this->data, [&](Group& g) {
    g.clear(0);
    g.clear(1);
    g.sync();
    g.each_batch(
        [&](const typename Group::Batch& b) { this->scatter_batch(g, block, b, expected); });
    g.sync();
    g.stage_out(0);
    g.stage_out(1);
    ++block;
  });
  for (int c = 0; c < 2; ++c) {
    double largest = 0;
    for (const double x : expected[c]) largest = std::max(largest, std::abs(x));
    ASSERT_GT(largest, 0.1);
    for (std::size_t i = 0; i < expected[c].size(); ++i) {
      ASSERT_NEAR(this->scene.write[c][i], expected[c][i], this->tolerance * largest) << i;
    }
  }
}

/// What both ways gather, lane by lane.
template <class V, int D>
void expect_equal_lanes(int lanes, const V (&velocity)[2][D], const V (&affine)[2][D][D],
                        double tolerance) {
  for (int l = 0; l < lanes; ++l) {
    for (int c = 0; c < D; ++c) {
      ASSERT_NEAR(lane(velocity[0][c], l), lane(velocity[1][c], l), tolerance);
      for (int a = 0; a < D; ++a) {
        ASSERT_NEAR(lane(affine[0][c][a], l), lane(affine[1][c][a], l), tolerance);
      }
    }
  }
}

/// The transfers over all lattices at once against the same, lattice by lattice.
TYPED_TEST(CpuGroupTest, AffineTransfersAreTheSumOverTheLattices) {
  using Group = typename TestFixture::Group;
  using V = typename Group::V;
  using T = typename TypeParam::T;
  constexpr int D = TypeParam::D;
  this->data.write[1] = this->scene.write[1].data();
  this->scene.template run<Group>(this->data, [&](Group& g) {
    g.stage_in(0);
    g.clear(0);
    g.clear(1);
    g.sync();
    g.each_batch([&](const typename Group::Batch& b) {
      V u[D];
      const auto p = this->point_of(g, b, u);
      V velocity[2][D];
      V affine[2][D][D];
      g.gather_affine(0, p.stencil, velocity[0], affine[0]);
      LatticeSums::gather_affine(g, 0, p.stencil, velocity[1], affine[1]);
      expect_equal_lanes(b.active, velocity, affine, this->tolerance);
      V mask = select(g.active(b), broadcast<V>(T(1)), broadcast<V>(T(0)));
      for (int l = 1; l < Group::width; l += 3) set_lane(mask, l, T(0));
      const V mass = g.load(b, D) * T(0.5);
      g.scatter_affine(0, p.stencil, velocity[0], mass, affine[0], mask);
      LatticeSums::scatter_affine(g, 1, p.stencil, velocity[0], mass, affine[0], mask);
    });
    g.sync();
    g.stage_out(0);
    g.stage_out(1);
  });
  double largest = 0;
  for (const T x : this->scene.write[1]) largest = std::max(largest, std::abs(double(x)));
  ASSERT_GT(largest, 0.1);
  for (std::size_t i = 0; i < this->scene.write[0].size(); ++i) {
    ASSERT_NEAR(this->scene.write[0][i], this->scene.write[1][i], this->tolerance * largest) << i;
  }
}

// ---- results of a block ------------------------------------------------------------------------

using Plain = CpuGroup<2, double, Compact>;
using V = Plain::V;

/// 11 particles: full batches and one that is not, ids 0 .. 10; the id picks the lanes.
struct CpuGroupResult : ::testing::Test {
  BlockScene<2, double> scene{Compact::lattices, {11}, 5};
  PassData<2, double> data = scene.data();

  static V ids(const Plain::Batch& b) {
    V id = broadcast<V>(100);  // padding
    for (int l = 0; l < b.active; ++l) set_lane(id, l, double(b.id[l]));
    return id;
  }
  template <class F>
  const BlockResult<double>& after(F&& f) {
    scene.run<Plain>(data, [&](Plain& g) { g.each_batch([&](const auto& b) { f(g, b); }); });
    return scene.results[0];
  }
};

TEST_F(CpuGroupResult, MaximaOverTheLanesOfTheMask) {
  const auto& result = after([](Plain& g, const Plain::Batch& b) {
    g.note_motion(ids(b) < 10.0, ids(b), ids(b) * 2.0);
    g.note_signal(ids(b) < 9.0, ids(b) * 3.0);
  });
  EXPECT_EQ(result.max_speed, 9.0);
  EXPECT_EQ(result.max_excursion, 18.0);
  EXPECT_EQ(result.max_signal, 24.0);
  EXPECT_EQ(result.fault, FaultCode::none);
  EXPECT_EQ(result.dead, 0);
}

TEST_F(CpuGroupResult, KeepsTheFirstFault) {
  const auto& result = after([](Plain& g, const Plain::Batch& b) {
    const V u[2] = {ids(b) * 0.1, ids(b) * 0.2};
    g.fault(ids(b) > 1e3, FaultCode::left_domain, ids(b), u, b);  // no lane
    g.fault((ids(b) > 8.5) & g.active(b), FaultCode::not_finite, ids(b) * 7.0, u, b);
    g.fault(g.active(b), FaultCode::moved_too_far, ids(b), u, b);
  });
  EXPECT_EQ(result.fault, FaultCode::moved_too_far);  // of the first batch
  EXPECT_EQ(result.fault_id, 0);
  const auto& later = after([](Plain& g, const Plain::Batch& b) {
    const V u[2] = {ids(b) * 0.1, ids(b) * 0.2};
    g.fault((ids(b) > 8.5) & g.active(b), FaultCode::not_finite, ids(b) * 7.0, u, b);
  });
  EXPECT_EQ(later.fault, FaultCode::not_finite);
  EXPECT_EQ(later.fault_id, 9);
  EXPECT_EQ(later.fault_value, 63.0);
  EXPECT_EQ(later.fault_position[0], 9 * 0.1);
  EXPECT_EQ(later.fault_position[1], 9 * 0.2);
}

TEST_F(CpuGroupResult, MarksRemovedParticles) {
  const auto& result =
      after([](Plain& g, const Plain::Batch& b) { g.remove((ids(b) > 5.5) & (ids(b) < 8.5), b); });
  EXPECT_EQ(result.dead, 3);
  for (int p = 0; p < 11; ++p) {
    EXPECT_EQ(data.ids[p], p >= 6 && p <= 8 ? -1 : p);
  }
}

// ---- register transposes -----------------------------------------------------------------------

template <class T>
void expect_transposed() {
  using Transpose = LaneTranspose<T>;
  constexpr int width = Transpose::width;
  constexpr int count = Transpose::record * width;
  alignas(64) T quantities[count];
  alignas(64) T records[count];
  alignas(64) T back[count];
  for (int q = 0; q < Transpose::record; ++q) {
    for (int l = 0; l < width; ++l) quantities[q * width + l] = T(100 * q + l);
  }
  Transpose::to_records(quantities, records);
  for (int l = 0; l < width; ++l) {
    for (int q = 0; q < Transpose::record; ++q) {
      EXPECT_EQ(records[l * Transpose::record + q], T(100 * q + l));
    }
  }
  Transpose::to_lanes(records, back);
  for (int i = 0; i < count; ++i) EXPECT_EQ(back[i], quantities[i]);
  using V = RegisterLanes<T>;
  V quad[4];
  for (int q = 0; q < 4; ++q) quad[q] = load<V>(quantities + q * width);
  Transpose::to_quads(quad[0], quad[1], quad[2], quad[3], records);
  for (int l = 0; l < width; ++l) {
    for (int q = 0; q < 4; ++q) {
      EXPECT_EQ(records[Transpose::quad_place(l) + q], T(100 * q + l)) << "lane " << l;
    }
  }
}

TEST(LaneTranspose, TurnsQuantitiesIntoRecordsAndBack) {
  expect_transposed<float>();
  expect_transposed<double>();
}

}  // namespace
}  // namespace scree::testing
