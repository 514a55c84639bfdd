// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/collider.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/error.hpp"
#include "solver/io/memory_archive.hpp"

namespace scree {
namespace {

/// A plate [0.3, 0.4] x [0.2, 0.25] with this velocity.
ColliderSpec plate(const std::string& vx, const std::string& vy) {
  ColliderSpec spec;
  spec.name = "plate";
  spec.shape.lower = {0.3, 0.2, 0};
  spec.shape.upper = {0.4, 0.25, 0};
  spec.velocity[0].text = vx;
  spec.velocity[1].text = vy;
  spec.contact = {ContactType::friction, 0.3};
  return spec;
}

TEST(Collider, KeepsWhatTheDeckSays) {
  const Collider collider(plate("0", "0"), 2, 0.01);
  EXPECT_EQ(collider.name(), "plate");
  EXPECT_EQ(collider.contact(), ContactType::friction);
  EXPECT_EQ(collider.coefficient(), 0.3);
}

TEST(Collider, WithoutAVelocityItRests) {
  ColliderSpec spec = plate("", "");
  Collider collider(spec, 2, 0.01);
  collider.set_step(0, 1);
  collider.advance(1);
  for (int a = 0; a < 3; ++a) {
    EXPECT_EQ(collider.velocity()[a], 0);
    EXPECT_EQ(collider.displacement()[a], 0);
  }
}

TEST(Collider, ShapeNormalAndReferencePointMoveWithIt) {
  Collider collider(plate("0.5", "-1"), 2, 0.01);
  const double inside[3] = {0.35, 0.24, 0}, moved[3] = {0.45, 0.04, 0};
  EXPECT_TRUE(collider.touches(inside));
  EXPECT_FALSE(collider.touches(moved));
  collider.set_step(0, 0.2);
  collider.advance(0.2);  // by (0.1, -0.2)
  EXPECT_FALSE(collider.touches(inside));
  EXPECT_TRUE(collider.touches(moved));
  EXPECT_EQ(collider.normal(moved)[1], 1);
  EXPECT_NEAR(collider.reference_point()[0], 0.45, 1e-15);
  EXPECT_NEAR(collider.reference_point()[1], 0.025, 1e-15);
  EXPECT_NEAR(collider.bounds().lower[1], 0.0, 1e-15);
}

TEST(Collider, NodesOnTheSurfaceTouch) {
  const Collider collider(plate("0", "0"), 2, 0.05);
  for (int i = 6; i <= 8; ++i) {
    const double on_top[3] = {0.05 * i, 0.25, 0}, below[3] = {0.05 * i, 0.05 * 4, 0};
    EXPECT_TRUE(collider.touches(on_top)) << i;
    EXPECT_TRUE(collider.touches(below)) << i;
  }
  const double off[3] = {0.35, 0.2501, 0};
  EXPECT_FALSE(collider.touches(off));
}

// Midpoint rule of sin(2 pi t) over [0, 1/4]: exact integral 1/(2 pi), error (dt omega)^2 / 24.
TEST(Collider, MotionIsSecondOrderAccurate) {
  const double omega = 2 * M_PI;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    Collider collider(plate("sin(2*pi*t)", "0"), 2, 0.01);
    const int steps = level == 0 ? 10 : 20;
    const double dt = 0.25 / steps;
    for (int i = 0; i < steps; ++i) {
      collider.set_step(i * dt, dt);
      collider.advance(dt);
    }
    error[level] = collider.displacement()[0] - 1 / omega;
    EXPECT_NEAR(error[level], dt * dt * omega / 24, 0.01 * dt * dt * omega / 24);
  }
  EXPECT_NEAR(error[0] / error[1], 4, 0.05);
}

TEST(Collider, AHalfSpaceTurnsAboutItsOwnPoint) {
  ColliderSpec spec = plate("0", "0");
  spec.shape = {};
  spec.shape.kind = ShapeKind::plane;
  spec.shape.point = {0.1, 0.2, 0};
  spec.shape.normal = {0, 2, 0};
  const Collider collider(spec, 2, 0.01);
  EXPECT_EQ(collider.reference_point()[0], 0.1);
  EXPECT_EQ(collider.reference_point()[1], 0.2);
  const double deep[3] = {5, -100, 0};
  EXPECT_TRUE(collider.touches(deep));
  EXPECT_EQ(collider.normal(deep)[1], 1);
}

TEST(Collider, StateComesBackBitForBit) {
  Collider a(plate("0.1+t", "cos(t)"), 2, 0.01), b(plate("0.1+t", "cos(t)"), 2, 0.01);
  for (int i = 0; i < 7; ++i) {
    a.set_step(0.01 * i, 0.01);
    a.advance(0.01);
  }
  MemoryArchive archive;
  a.save(archive);
  b.load(archive);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a.displacement()[i], b.displacement()[i]);
  EXPECT_GT(b.displacement()[0], 0);
}

TEST(Collider, AVelocityThatIsNoNumberStopsTheRun) {
  Collider collider(plate("1/(t-0.5)", "0"), 2, 0.01);
  collider.set_step(0, 0.1);
  EXPECT_THROW(collider.set_step(0.4, 0.2), RunFault);
}

}  // namespace
}  // namespace scree
