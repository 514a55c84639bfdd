// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace scree {
namespace {

template <class T>
class Contact : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Contact, Reals);

/// Some roundings of velocities up to 4 m/s.
template <class T>
constexpr double rounding = 32 * std::numeric_limits<T>::epsilon();

template <class T>
struct Meeting {
  Vec3<T> v, object, normal;
};

/// Random velocities and a random unit normal.
template <class T>
Meeting<T> meeting(std::mt19937& random) {
  std::uniform_real_distribution<T> uniform(-2, 2);
  Meeting<T> m;
  for (int a = 0; a < 3; ++a) {
    m.v[a] = uniform(random);
    m.object[a] = uniform(random);
    m.normal[a] = uniform(random);
  }
  m.normal = m.normal * (1 / norm(m.normal));
  return m;
}

TYPED_TEST(Contact, StickyTakesTheVelocityOfTheObject) {
  std::mt19937 random(1);
  const auto m = meeting<TypeParam>(random);
  const auto v = contact_velocity<TypeParam, 3>(ContactType::sticky, 0, m.v, m.object, m.normal);
  for (int a = 0; a < 3; ++a) EXPECT_EQ(v[a], m.object[a]);
}

TYPED_TEST(Contact, SlipTakesTheRelativeNormalVelocityOnly) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const auto m = meeting<TypeParam>(random);
    const auto v = contact_velocity<TypeParam, 3>(ContactType::slip, 0, m.v, m.object, m.normal);
    EXPECT_NEAR(dot(v - m.object, m.normal), 0, rounding<TypeParam>);
    // What changed is normal to the surface.
    EXPECT_NEAR(norm(cross(v - m.v, m.normal)), 0, rounding<TypeParam>);
  }
}

TYPED_TEST(Contact, SeparateIsSlipWhenApproachingAndFreeWhenLeaving) {
  std::mt19937 random(3);
  int approaching = 0;
  for (int i = 0; i < 100; ++i) {
    const auto m = meeting<TypeParam>(random);
    const auto v =
        contact_velocity<TypeParam, 3>(ContactType::separate, 0, m.v, m.object, m.normal);
    const bool near = dot(m.v - m.object, m.normal) < 0;
    const auto slip = contact_velocity<TypeParam, 3>(ContactType::slip, 0, m.v, m.object, m.normal);
    for (int a = 0; a < 3; ++a) EXPECT_EQ(v[a], near ? slip[a] : m.v[a]);
    approaching += near;
  }
  EXPECT_GT(approaching, 20);
  EXPECT_LT(approaching, 80);
}

// A node that comes in at (3, -2) on ground that moves with (1, 0): relative (2, -2).
TYPED_TEST(Contact, FrictionLeavesTheTangentialSpeedLessMuTimesTheNormalOne) {
  using T = TypeParam;
  const Vec3<T> v{{3, -2, 0}}, ground{{1, 0, 0}}, up{{0, 1, 0}};
  const auto sliding = contact_velocity<T, 2>(ContactType::friction, T(0.25), v, ground, up);
  EXPECT_EQ(sliding[0], T(1 + (2 - 0.25 * 2)));
  EXPECT_EQ(sliding[1], T(0));
  const auto held = contact_velocity<T, 2>(ContactType::friction, T(1.5), v, ground, up);
  EXPECT_EQ(held[0], T(1));
  EXPECT_EQ(held[1], T(0));
  const Vec3<T> leaving{{3, 2, 0}};
  const auto free = contact_velocity<T, 2>(ContactType::friction, T(1.5), leaving, ground, up);
  EXPECT_EQ(free[0], T(3));
  EXPECT_EQ(free[1], T(2));
}

TYPED_TEST(Contact, FrictionActsAgainstTheSlidingAndNeverTurnsIt) {
  using T = TypeParam;
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const auto m = meeting<T>(random);
    const T mu = T(0.7);
    const auto v = contact_velocity<T, 3>(ContactType::friction, mu, m.v, m.object, m.normal);
    const T approach = dot(m.v - m.object, m.normal);
    if (approach >= 0) continue;
    const Vec3<T> before = m.v - m.object - m.normal * approach, after = v - m.object;
    EXPECT_NEAR(dot(after, m.normal), 0, rounding<T>);
    EXPECT_NEAR(norm(cross(before, after)), 0, 4 * rounding<T>);
    EXPECT_GE(dot(before, after), -rounding<T>);
    EXPECT_NEAR(norm(after), std::max(T(0), norm(before) + mu * approach), rounding<T>);
  }
}

TYPED_TEST(Contact, AHeadOnMeetingStops) {
  using T = TypeParam;
  const Vec3<T> v{{0, -1, 0}}, ground{{0, 0, 0}}, up{{0, 1, 0}};
  const auto stopped = contact_velocity<T, 3>(ContactType::friction, T(0.5), v, ground, up);
  for (int a = 0; a < 3; ++a) EXPECT_EQ(stopped[a], T(0));  // and no 0/0
}

}  // namespace
}  // namespace scree
