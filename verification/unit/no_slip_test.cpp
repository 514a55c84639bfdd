// SPDX-License-Identifier: Apache-2.0
//
// Walls that hold the material at the wall itself (NoSlip::face), pair by pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "verification/support/wall_pair.hpp"

namespace scree::testing {
namespace {

// What it takes to stop a pair at a wall normal to y that is above: twice its reduced momentum.
Vec3<double> stopping_impulse(const Node& real, const Node& ghost) {
  Vec3<double> stop;
  for (int a = 0; a < 3; ++a)
    stop[a] = 2 * (ghost.mass * real.momentum[a] + real.mass * ghost.momentum[a]) /
              (real.mass + ghost.mass);
  return stop;
}

TEST(NoSlipAtFaces, FrictionAtTheFaceHoldsWhatCoulombAllowsAndSlidesElse) {
  std::mt19937 random(15);
  int sliding = 0, held = 0, left = 0;
  for (int i = 0; i < 600; ++i) {
    const Node real = random_node(random), ghost = random_node(random);
    const double mu = 0.7;
    const Outcome after = apply(FaceType::friction, mu, 1, 1, real, ghost, NoSlip::face);
    const Vec3<double> stop = stopping_impulse(real, ghost);
    const double wanted = std::hypot(stop[0], stop[2]);
    const double taken = std::hypot(after.impulse[0], after.impulse[2]);
    if (stop[1] <= 0) {  // the pair leaves
      for (int a = 0; a < 3; ++a) EXPECT_EQ(after.ghost[a], ghost.momentum[a] / ghost.mass);
      ++left;
      continue;
    }
    EXPECT_NEAR(after.impulse[1], stop[1], rounding);
    EXPECT_NEAR(after.ghost[1], -after.real[1], 100 * rounding);  // masses from 0.01 on
    if (wanted <= mu * stop[1]) {
      for (int a = 0; a < 3; ++a) EXPECT_NEAR(after.impulse[a], stop[a], rounding);
      for (int a = 0; a < 3; ++a) EXPECT_EQ(after.ghost[a], -after.real[a]);
      ++held;
      continue;
    }
    EXPECT_NEAR(taken, mu * stop[1], rounding);
    for (int a : {0, 2}) {  // against the sliding, one half from each node
      EXPECT_NEAR(after.impulse[a], taken / wanted * stop[a], rounding);
      EXPECT_NEAR(real.momentum[a] - real.mass * after.real[a], after.impulse[a] / 2, rounding);
      EXPECT_NEAR(ghost.momentum[a] - ghost.mass * after.ghost[a], after.impulse[a] / 2, rounding);
    }
    EXPECT_FALSE(after.folded);
    ++sliding;
  }
  EXPECT_GT(std::min({sliding, held, left}), 50);
}

TEST(NoSlipAtFaces, FrictionAtTheFaceIsContinuousWhereItBeginsToSlide) {
  std::mt19937 random(16);
  const double small = 1e-9;
  for (int i = 0; i < 100; ++i) {
    const Node real = random_node(random), ghost = random_node(random);
    const Vec3<double> stop = stopping_impulse(real, ghost);
    if (stop[1] < 0.01) continue;
    const double mu = std::hypot(stop[0], stop[2]) / stop[1];
    const Outcome hold =
        apply(FaceType::friction, mu * (1 + small), 1, 1, real, ghost, NoSlip::face);
    const Outcome slide =
        apply(FaceType::friction, mu * (1 - small), 1, 1, real, ghost, NoSlip::face);
    EXPECT_TRUE(hold.folded && !slide.folded);
    for (int a = 0; a < 3; ++a) {  // momenta of about 1, masses from 0.01 on
      EXPECT_NEAR(hold.real[a], slide.real[a], 100 * small);
      EXPECT_NEAR(hold.ghost[a], slide.ghost[a], 100 * small);
    }
  }
}

// Friction takes nothing from what moves along the wall unpushed, and a smooth wall is slip in the
// normal direction.
TEST(NoSlipAtFaces, FrictionAtTheFaceWithoutACoefficientTakesTheNormalPartOnly) {
  std::mt19937 random(17);
  for (int i = 0; i < 100; ++i) {
    const Node real = random_node(random), ghost = random_node(random);
    const Outcome slip = apply(FaceType::separate, 0, 1, 1, real, ghost);
    const Outcome after = apply(FaceType::friction, 0, 1, 1, real, ghost, NoSlip::face);
    EXPECT_NEAR(after.real[1], slip.real[1], 100 * rounding);  // masses from 0.01 on
    EXPECT_NEAR(after.ghost[1], slip.ghost[1], 100 * rounding);
    for (int a : {0, 2}) {
      EXPECT_EQ(after.real[a], real.momentum[a] / real.mass);
      EXPECT_EQ(after.ghost[a], ghost.momentum[a] / ghost.mass);
    }
  }
}

// The rule of faces: no velocity at the wall between the nodes.
TEST(NoSlipAtFaces, AHeldWallTurnsTheVelocityAround) {
  std::mt19937 random(13);
  for (int i = 0; i < 100; ++i) {
    const Node real = random_node(random), ghost = random_node(random);
    const Outcome held = apply(FaceType::sticky, 0, 1, 1, real, ghost, NoSlip::face);
    const Vec3<double> stop = stopping_impulse(real, ghost);
    for (int a = 0; a < 3; ++a) {
      EXPECT_EQ(held.ghost[a], -held.real[a]);
      EXPECT_NEAR(held.impulse[a], stop[a], rounding);
      EXPECT_NEAR(real.momentum[a] - real.mass * held.real[a], stop[a] / 2, rounding);
    }
  }
}

// A uniform stress in the material beside a wall pulls at both nodes with one half of the traction,
// whatever their masses. By the rule of faces the wall bears all of it, and what was at rest stays
// so; by that of nodes a held wall bears one half of the shear stress.
TEST(NoSlipAtFaces, AWallThatHoldsBearsAUniformStress) {
  std::mt19937 random(14);
  for (FaceType type : {FaceType::sticky, FaceType::friction})
    for (int i = 0; i < 100; ++i) {
      Node real = random_node(random), ghost = random_node(random);
      const Vec3<double> half{{0.1, 0.5, -0.2}};  // normal 1, tangential 0.45 < mu
      real.momentum = ghost.momentum = half;
      const Outcome after = apply(type, 0.5, 1, 1, real, ghost, NoSlip::face);
      for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(after.impulse[a], 2 * half[a], rounding);
        EXPECT_NEAR(after.real[a], 0, 100 * rounding);  // masses from 0.01 on
        EXPECT_NEAR(after.ghost[a], 0, 100 * rounding);
      }
      const Outcome sticky = apply(FaceType::sticky, 0, 1, 1, real, ghost);
      for (int a : {0, 2}) EXPECT_EQ(sticky.impulse[a], half[a]);
    }
}

TEST(NoSlipAtFaces, FacesThatDependOnVelocitiesFoldAfterMirrorsAndHeldOnesLast) {
  for (FaceType type : walls) {
    const bool sticky = type == FaceType::sticky;
    const bool may_leave = type == FaceType::separate || type == FaceType::friction;
    EXPECT_EQ(fold_stage(type, NoSlip::node), sticky ? 2 : 0);
    EXPECT_EQ(fold_stage(type, NoSlip::face), sticky ? 2 : may_leave ? 1 : 0);
  }
}

}  // namespace
}  // namespace scree::testing
