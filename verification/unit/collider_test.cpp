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

/// x from -0.1 m to 0.9 m repeats.
Periods one_metre() { return {{-0.1, 0, 0}, {1, 0, 0}}; }

TEST(Collider, BeyondAPeriodicFaceItComesInAtTheOther) {
  Collider collider(plate("0.5", "0"), 2, 0.01, one_metre());
  EXPECT_FALSE(std::isfinite(collider.bounds().upper[0]));
  EXPECT_EQ(collider.bounds().upper[1], 0.25);
  collider.set_step(0, 1.1);
  collider.advance(1.1);  // by 0.55 m: to [0.85, 0.95], of which 0.9 to 0.95 is -0.1 to -0.05
  const double here[3] = {0.86, 0.24, 0}, there[3] = {-0.06, 0.24, 0}, between[3] = {0.4, 0.24, 0};
  EXPECT_TRUE(collider.touches(here));
  EXPECT_TRUE(collider.touches(there));
  EXPECT_FALSE(collider.touches(between));
  // 1e-15: sums of numbers near 1.
  EXPECT_NEAR(collider.distance(here), -0.01, 1e-15);
  EXPECT_NEAR(collider.distance(there), -0.01, 1e-15);
  EXPECT_NEAR(collider.distance(between), 0.45, 1e-15);
  EXPECT_EQ(collider.normal(there)[1], 1);
  const double right_of_it[3] = {-0.0501, 0.22, 0};
  EXPECT_EQ(collider.normal(right_of_it)[0], 1);
  EXPECT_NEAR(collider.unwrapped(here)[0], 0.86, 1e-15);
  EXPECT_NEAR(collider.unwrapped(there)[0], 0.94, 1e-15);
  for (int i = 0; i < 7; ++i) collider.advance(10);  // 35 m: the same place
  EXPECT_NEAR(collider.distance(there), -0.01, 1e-14);
  EXPECT_NEAR(collider.unwrapped(there)[0], 35.94, 1e-13);
}

TEST(Collider, ALongFloorIsAFloorAtEveryPlaceOfAPeriodicDomain) {
  ColliderSpec spec = plate("3", "0");
  for (const double half : {0.7, 3.0, 1e5}) {
    spec.shape.lower = {-half, -1, 0};
    spec.shape.upper = {half, 0.05, 0};
    Collider floor(spec, 2, 0.01, one_metre());
    for (int step = 0; step < 20; ++step) {
      for (const double x : {-0.1, 0.2, 0.9}) {
        const double below[3] = {x, 0.02, 0}, above[3] = {x, 0.06, 0};
        EXPECT_TRUE(floor.touches(below)) << half << " " << step << " " << x;
        EXPECT_EQ(floor.normal(below)[1], 1) << half << " " << step << " " << x;
        EXPECT_FALSE(floor.touches(above));
      }
      floor.set_step(0, 0.1);
      floor.advance(0.1);
    }
  }
}

TEST(Collider, AHalfSpaceIsNotRepeated) {
  ColliderSpec spec = plate("0", "0");
  spec.shape = {};
  spec.shape.kind = ShapeKind::plane;
  spec.shape.normal = {0, 1, 0};
  const Collider collider(spec, 2, 0.01, one_metre());
  const double deep[3] = {0.8, -0.5, 0};
  EXPECT_EQ(collider.distance(deep), -0.5);
  EXPECT_EQ(collider.unwrapped(deep)[0], 0.8);
  EXPECT_TRUE(std::isinf(collider.bounds().lower[1]));
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
