// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "verification/support/wall_pair.hpp"

namespace scree::testing {
namespace {

TEST(Faces, MirrorNodes) {
  // Nodes at i dx about a wall at 3 dx: 2 <-> 4, 3 its own; nodes at (i + 1/2) dx: 2 <-> 3.
  EXPECT_EQ(mirror_index(4, 3, 0), 2);
  EXPECT_EQ(mirror_index(3, 3, 0), 3);
  EXPECT_EQ(mirror_index(3, 3, 1), 2);
  EXPECT_EQ(mirror_index(-1, 0, 1), 0);
  for (int half : {0, 1})
    for (int i = -5; i < 5; ++i) EXPECT_EQ(mirror_index(mirror_index(i, 2, half), 2, half), i);
}

TEST(Faces, ImpulseIsTheMomentumLostAndEnergyNeverGrows) {
  std::mt19937 random(1);
  for (FaceType type : walls)
    for (int i = 0; i < 600; ++i) {
      const int axis = i % 3, outward = i % 2 ? 1 : -1;
      const Node real = random_node(random), ghost = random_node(random);
      const Outcome after = apply(type, 0.4, axis, outward, real, ghost, rules[i % 4 / 2]);
      for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(real.momentum[a] + ghost.momentum[a] - real.mass * after.real[a] -
                        ghost.mass * after.ghost[a],
                    after.impulse[a], rounding);
      const double before = energy(real.mass, node_velocity<double, 3>(real)) +
                            energy(ghost.mass, node_velocity<double, 3>(ghost));
      EXPECT_LE(energy(real.mass, after.real) + energy(ghost.mass, after.ghost),
                before * (1 + rounding));
    }
}

TEST(Faces, SlipKeepsTheTangentialMomentum) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const int axis = i % 3;
    const Outcome after =
        apply(FaceType::slip, 0, axis, 1, random_node(random), random_node(random));
    for (int a = 0; a < 3; ++a) EXPECT_EQ(a == axis || after.impulse[a] == 0, true);
    EXPECT_TRUE(after.folded);
  }
}

// Any other velocity that obeys the constraint is farther away in the norm of the masses.
TEST(Faces, FoldingIsTheNearestVelocityThatObeysTheWall) {
  std::mt19937 random(3);
  std::normal_distribution<double> step(0, 0.1);
  for (FaceType type : {FaceType::slip, FaceType::symmetry, FaceType::sticky})
    for (int i = 0; i < 200; ++i) {
      const NoSlip rule = rules[i % 2];
      const Node real = random_node(random), ghost = random_node(random);
      const Vec3<double> free_real = node_velocity<double, 3>(real);
      const Vec3<double> free_ghost = node_velocity<double, 3>(ghost);
      const auto distance = [&](const Vec3<double>& v) {
        return energy(real.mass, v - free_real) +
               energy(ghost.mass, mirror_velocity<double, 3>(type, rule, 1, v) - free_ghost);
      };
      const Outcome after = apply(type, 0, 1, 1, real, ghost, rule);
      const Vec3<double> other =
          after.real + Vec3<double>{{step(random), step(random), step(random)}};
      EXPECT_LT(distance(after.real), distance(other));
    }
}

TEST(Faces, SeparateActsOnlyWhenTheWallPushes) {
  std::mt19937 random(4);
  int pushed = 0;
  for (int i = 0; i < 200; ++i) {
    const Node real = random_node(random), ghost = random_node(random);
    const int outward = i % 2 ? 1 : -1;
    const Outcome slip = apply(FaceType::slip, 0, 0, outward, real, ghost);
    const Outcome after = apply(FaceType::separate, 0, 0, outward, real, ghost);
    const bool pushes = outward * slip.impulse[0] > 0;
    EXPECT_EQ(after.folded, pushes);
    const Vec3<double> expected = pushes ? slip.real : node_velocity<double, 3>(real);
    for (int a = 0; a < 3; ++a) EXPECT_EQ(after.real[a], expected[a]);
    pushed += pushes;
  }
  EXPECT_GT(pushed, 50);
  EXPECT_LT(pushed, 150);
}

TEST(Faces, FrictionImpulseIsMuTimesTheNormalOneWhileSliding) {
  std::mt19937 random(5);
  int sliding = 0, held = 0;
  for (int i = 0; i < 400; ++i) {
    const Node real = random_node(random), ghost = random_node(random);
    const double mu = 0.5;
    const Outcome slip = apply(FaceType::slip, 0, 1, 1, real, ghost);
    const Outcome after = apply(FaceType::friction, mu, 1, 1, real, ghost);
    if (!after.folded) continue;
    const double normal = after.impulse[1];
    const double tangential = std::hypot(after.impulse[0], after.impulse[2]);
    EXPECT_NEAR(normal, slip.impulse[1], rounding);  // friction does not change the normal part
    const double speed = std::hypot(after.real[0], after.real[2]);
    if (speed > 1e-9) {
      EXPECT_NEAR(tangential, mu * normal, rounding);
      // Along the sliding, against it.
      EXPECT_NEAR(after.impulse[0] * after.real[2], after.impulse[2] * after.real[0], rounding);
      EXPECT_GT(after.impulse[0] * after.real[0] + after.impulse[2] * after.real[2], 0);
      ++sliding;
    } else {
      EXPECT_LE(tangential, mu * normal + rounding);
      ++held;
    }
  }
  EXPECT_GT(sliding, 10);
  EXPECT_GT(held, 10);
}

TEST(Faces, NodesOnTheWall) {
  const Node start{2, {{3, 4, 12}}};
  for (int outward : {-1, 1})
    for (FaceType type : walls) {
      Node node = start;
      const Vec3<double> impulse = plane_node<double, 3>(type, 0.5, 0, outward, node);
      for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(impulse[a] + node.momentum[a], start.momentum[a], rounding);
      const bool may_leave = type == FaceType::separate || type == FaceType::friction;
      EXPECT_EQ(node.momentum[0], may_leave && outward < 0 ? 3 : 0);
      // J = 3: friction takes mu J = 1.5.
      const bool rubs = type == FaceType::friction && outward > 0;
      const double lost = type == FaceType::sticky ? std::hypot(4, 12) : rubs ? 1.5 : 0;
      EXPECT_NEAR(std::hypot(impulse[1], impulse[2]), lost, 10 * rounding);
    }
  Node slow{2, {{3, 0.1, 0}}};
  plane_node<double, 3>(FaceType::friction, 0.5, 0, 1, slow);
  EXPECT_EQ(slow.momentum[1], 0);
}

TEST(Faces, NodesWithoutMass) {
  std::mt19937 random(6);
  const Node empty{0, {}}, full = random_node(random);
  for (FaceType type : walls)
    for (NoSlip rule : rules) {
      const Outcome none = apply(type, 0.3, 0, 1, empty, empty, rule);
      for (int a = 0; a < 3; ++a) EXPECT_EQ(none.real[a], 0);
      const Outcome one = apply(type, 0.3, 0, 1, full, empty, rule);
      for (int a = 0; a < 3; ++a) {
        EXPECT_DOUBLE_EQ(one.real[a], full.momentum[a] / full.mass);
        EXPECT_EQ(one.impulse[a], 0);
      }
      const Outcome other = apply(type, 0.3, 0, 1, empty, full, rule);
      for (int a = 0; a < 3; ++a) {
        // Nothing holds the normal motion.
        const bool stopped = type == FaceType::sticky && rule == NoSlip::node && a != 0;
        EXPECT_DOUBLE_EQ(other.ghost[a], stopped ? 0 : full.momentum[a] / full.mass);
        EXPECT_EQ(other.impulse[a], stopped ? full.momentum[a] : 0);
      }
      Node plane = empty;
      plane_node<double, 3>(type, 0.3, 0, 1, plane);
      for (int a = 0; a < 3; ++a) EXPECT_EQ((node_velocity<double, 3>(plane)[a]), 0);
    }
}

// The rule of nodes: a held wall stops the ghost along the wall, leaves the real node's tangential
// velocity alone and mirrors the normal one as slip does.
TEST(Faces, AHeldWallStopsTheGhostAlongTheWall) {
  std::mt19937 random(12);
  for (int i = 0; i < 100; ++i) {
    const Node real = random_node(random), ghost = random_node(random);
    const Outcome held = apply(FaceType::sticky, 0, 1, 1, real, ghost);
    const Outcome slip = apply(FaceType::slip, 0, 1, 1, real, ghost);
    EXPECT_NEAR(held.real[1], slip.real[1], rounding);
    EXPECT_NEAR(held.ghost[1], slip.ghost[1], rounding);
    for (int a : {0, 2}) {
      EXPECT_NEAR(held.real[a], real.momentum[a] / real.mass, 10 * rounding);
      EXPECT_EQ(held.ghost[a], 0);
      EXPECT_EQ(held.impulse[a], ghost.momentum[a]);
    }
  }
}

TEST(Faces, OpenAndPeriodicFacesDoNothing) {
  std::mt19937 random(7);
  for (FaceType type : {FaceType::open, FaceType::periodic}) {
    const Node real = random_node(random), ghost = random_node(random);
    const Outcome after = apply(type, 1, 2, 1, real, ghost, NoSlip::face);
    for (int a = 0; a < 3; ++a) {
      EXPECT_EQ(after.real[a], real.momentum[a] / real.mass);
      EXPECT_EQ(after.ghost[a], ghost.momentum[a] / ghost.mass);
      EXPECT_EQ(after.impulse[a], 0);
    }
  }
}

// ---- a body and its mirror image: the whole 2D corner -------------------------------------------

using Key = std::pair<int, int>;
using Lattice = std::map<Key, Node>;

double kernel(double u) {
  const double r = std::abs(u);
  return r < 1 ? 1 - r + std::sin(2 * std::numbers::pi * r) / (2 * std::numbers::pi) : 0;
}

struct Particle {
  double mass, x[2];
  Vec3<double> v;
};

/// Scatters to the nodes (i + half / 2) dx, dx = 1.
void scatter(Lattice& lattice, int half, const Particle& p) {
  for (int i = -3; i < 5; ++i)
    for (int j = -3; j < 5; ++j) {
      const double w = kernel(p.x[0] - i - 0.5 * half) * kernel(p.x[1] - j - 0.5 * half);
      if (w == 0) continue;
      Node& node = lattice[{i, j}];
      node.mass += w * p.mass;
      for (int a = 0; a < 2; ++a) node.momentum[a] += w * p.mass * p.v[a];
    }
}

Particle image(const Particle& p, FaceType type, int axis) {
  Particle q = p;
  q.x[axis] = -q.x[axis];
  q.v = mirror_velocity<double, 2>(type, NoSlip::face, axis, p.v);
  return q;
}

/// Folds the wall at 0 in `axis` for all nodes.
void fold(Lattice& lattice, int half, FaceType type, int axis) {
  for (auto& [key, node] : lattice) {
    Key other = key;
    int& along = axis == 0 ? other.first : other.second;
    along = static_cast<int>(mirror_index(along, 0, half));
    if (other == key) {
      plane_node<double, 2>(type, 0, axis, -1, node);
    } else if (key < other && lattice.count(other)) {
      fold_pair<double, 2>(type, NoSlip::face, 0, axis, -1, lattice.at(other), node);
    }
  }
}

// Particles near the corner x > 0, y > 0, walls at x = 0 and y = 0: folding gives the velocities of
// a computation without walls in which all four images of the body are present, those beyond a held
// wall (rule of faces) with their velocities turned around. G- nodes (half 0) lie on the walls, G+
// nodes (half 1) lie half a cell off.
TEST(Faces, ACornerEqualsTheBodyWithItsImages) {
  for (FaceType first : {FaceType::slip, FaceType::symmetry, FaceType::sticky})
    for (FaceType second : {FaceType::slip, FaceType::symmetry, FaceType::sticky})
      for (int half : {0, 1}) {
        std::mt19937 random(8);
        std::uniform_real_distribution<double> place(0, 1.6), speed(-1, 1);
        Lattice walled, whole;
        for (int n = 0; n < 12; ++n) {
          const Particle p{place(random) + 0.1,
                           {place(random), place(random)},
                           {{speed(random), speed(random), 0}}};
          scatter(walled, half, p);
          for (const Particle& q : {p, image(p, first, 0)}) {
            scatter(whole, half, q);
            scatter(whole, half, image(q, second, 1));
          }
        }
        // Every image of a node must exist to be folded.
        for (int i = -3; i < 5; ++i)
          for (int j = -3; j < 5; ++j) walled[{i, j}].mass += 0;
        fold(walled, half, first, 0);
        fold(walled, half, second, 1);
        int compared = 0;
        for (const auto& [key, node] : whole) {
          if (key.first < 0 || key.second < 0 || node.mass < 1e-6) continue;
          for (int a = 0; a < 2; ++a)
            EXPECT_NEAR((node_velocity<double, 2>(walled.at(key))[a]), node.momentum[a] / node.mass,
                        1e-11)
                << half << ' ' << key.first << ' ' << key.second;
          ++compared;
        }
        EXPECT_GE(compared, 4);
      }
}

// Four nodes in a corner, walls below in x and y, index 1 on the real side: after both folds and
// the unfolding in reverse order, both walls are obeyed by all nodes, and no energy has been added.
TEST(Faces, UnfoldingInReverseOrderObeysBothWalls) {
  std::mt19937 random(9);
  Node n[2][2];
  double mass[2][2], before = 0, after = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      n[i][j] = random_node(random);
      n[i][j].momentum[2] = 0;
      mass[i][j] = n[i][j].mass;
      before += energy(mass[i][j], node_velocity<double, 3>(n[i][j]));
    }
  constexpr NoSlip rule = NoSlip::node;
  constexpr FaceType slip = FaceType::slip;
  for (int j = 0; j < 2; ++j) fold_pair<double, 2>(slip, rule, 0, 0, -1, n[1][j], n[0][j]);
  for (int i = 0; i < 2; ++i) fold_pair<double, 2>(slip, rule, 0, 1, -1, n[i][1], n[i][0]);
  Vec3<double> v[2][2];
  v[1][1] = node_velocity<double, 2>(n[1][1]);
  v[1][0] = mirror_velocity<double, 2>(slip, rule, 1, v[1][1]);
  for (int j = 0; j < 2; ++j) v[0][j] = mirror_velocity<double, 2>(slip, rule, 0, v[1][j]);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      EXPECT_EQ(v[i][j][0], (i == 1 ? 1 : -1) * v[1][1][0]);
      EXPECT_EQ(v[i][j][1], (j == 1 ? 1 : -1) * v[1][1][1]);
      after += energy(mass[i][j], v[i][j]);
    }
  EXPECT_LE(after, before);
}

}  // namespace
}  // namespace scree::testing
