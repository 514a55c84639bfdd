// SPDX-License-Identifier: Apache-2.0
// log, log1p, exp, expm1, sin against long double (64-bit mantissa), with the accuracy their
// comments state.
#include "solver/base/math.hpp"

#include <gtest/gtest.h>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

using testing::ulps;

template <class V>
class MathTest : public ::testing::Test {
 protected:
  using T = Scalar<V>;
  struct Sweep {
    std::vector<T> points;
  };
  /// `count` points between a and b, evenly spaced or evenly in the logarithm, with random offsets.
  static std::vector<T> between(double a, double b, int count, bool geometric) {
    testing::MatrixSource random(7);
    std::vector<T> points;
    for (int i = 0; i < count; ++i) {
      const double s = (i + random.uniform(0, 1)) / count;
      // b / a may overflow, its logarithm does not.
      const double power = geometric ? std::log(b) - std::log(a) : 0;
      points.push_back(T(geometric ? std::exp(std::log(a) + power * s) : a + (b - a) * s));
    }
    return points;
  }
  /// Largest error in units in the last place; lanes must agree with the scalar to the bit (both
  /// use explicit fused operations), checked through `scalar`.
  template <class F, class G, class E>
  static double largest_error(const std::vector<T>& points, F f, G scalar, E exact) {
    double worst = 0;
    for (std::size_t i = 0; i + lanes_of<V> <= points.size(); i += lanes_of<V>) {
      V x{};
      for (int k = 0; k < lanes_of<V>; ++k) set_lane(x, k, points[i + k]);
      const V y = f(x);
      for (int k = 0; k < lanes_of<V>; ++k) {
        const T p = points[i + k];
        worst = std::max(worst, ulps(lane(y, k), exact((long double)p)));
        EXPECT_LE(ulps(lane(y, k), scalar(p)), 1.0) << "lane and scalar differ at " << p;
      }
    }
    return worst;
  }
};
TYPED_TEST_SUITE(MathTest, testing::LaneTypes);

constexpr int kCount = 200000;

TYPED_TEST(MathTest, LogIsWithinOneUnit) {
  using T = Scalar<TypeParam>;
  auto error = [&](const auto& points) {
    return this->largest_error(
        points, [](auto x) { return log(x); }, [](T x) { return log(x); },
        [](long double x) { return std::log(x); });
  };
  constexpr bool single = sizeof(T) == 4;
  EXPECT_LE(error(this->between(single ? 1.2e-38 : 2.3e-308, single ? 3e38 : 1e308, kCount, true)),
            1.0);
  EXPECT_LE(error(this->between(0.5, 2.0, kCount, false)), 1.0);
  EXPECT_LE(error(this->between(0.999, 1.001, kCount, false)), 1.0);
}

TYPED_TEST(MathTest, Log1pIsAccurateForSmallArguments) {
  using T = Scalar<TypeParam>;
  auto error = [&](const auto& points) {
    return this->largest_error(
        points, [](auto x) { return log1p(x); }, [](T x) { return log1p(x); },
        [](long double x) { return std::log1p(x); });
  };
  EXPECT_LE(error(this->between(1e-30, 10.0, kCount, true)), 2.0);
  EXPECT_LE(error(this->between(-0.9, 3.0, kCount, false)), 2.0);
}

TYPED_TEST(MathTest, ExpIsWithinOneAndAHalfUnits) {
  using T = Scalar<TypeParam>;
  auto error = [&](const auto& points) {
    return this->largest_error(
        points, [](auto x) { return exp(x); }, [](T x) { return exp(x); },
        [](long double x) { return std::exp(x); });
  };
  const double reach = sizeof(T) == 4 ? 86.9 : 707.9;
  EXPECT_LE(error(this->between(-reach, reach, kCount, false)), 1.5);
  EXPECT_LE(error(this->between(-1, 1, kCount, false)), 1.5);
}

TYPED_TEST(MathTest, Expm1IsAccurateForSmallArguments) {
  using T = Scalar<TypeParam>;
  auto error = [&](const auto& points) {
    return this->largest_error(
        points, [](auto x) { return expm1(x); }, [](T x) { return expm1(x); },
        [](long double x) { return std::expm1(x); });
  };
  EXPECT_LE(error(this->between(1e-20, 10.0, kCount, true)), 3.0);
  EXPECT_LE(error(this->between(-5.0, 5.0, kCount, false)), 3.0);
}

TYPED_TEST(MathTest, SinIsWithinTwoUnits) {
  using T = Scalar<TypeParam>;
  auto error = [&](const auto& points) {
    return this->largest_error(
        points, [](auto x) { return sin(x); }, [](T x) { return sin(x); },
        [](long double x) { return std::sin(x); });
  };
  EXPECT_LE(error(this->between(-1.5707963, 1.5707963, kCount, false)), 2.0);
  EXPECT_LE(error(this->between(1e-10, 1.5707963, kCount, true)), 2.0);
}

TYPED_TEST(MathTest, ExactValues) {
  using V = TypeParam;
  using T = Scalar<V>;
  EXPECT_EQ(lane(log(broadcast<V>(T(1))), 0), T(0));
  EXPECT_EQ(lane(exp(broadcast<V>(T(0))), 0), T(1));
  EXPECT_EQ(lane(expm1(broadcast<V>(T(0))), 0), T(0));
  EXPECT_EQ(lane(log1p(broadcast<V>(T(0))), 0), T(0));
  EXPECT_EQ(lane(exp(broadcast<V>(T(-1e6))), 0), exp(T(sizeof(T) == 4 ? -87 : -708)));
}

}  // namespace
}  // namespace scree
