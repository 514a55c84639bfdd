// SPDX-License-Identifier: Apache-2.0
// Every operation on lanes gives, in each lane, what it gives for the scalar.
#include "solver/base/pack.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "verification/support/lanes_testing.hpp"

namespace scree {
namespace {

template <class V>
class PackTest : public ::testing::Test {
 protected:
  using T = Scalar<V>;
  static constexpr int W = lanes_of<V>;

  /// Three operands with different signs, halves and equal values among the lanes.
  static V first() {
    return filled([](int i) { return T(0.75) * T(i - W / 2); });
  }
  static V second() {
    return filled([](int i) { return i % 3 == 0 ? T(0.75) * T(i - W / 2) : T(1.5); });
  }
  static V third() {
    return filled([](int i) { return T(0.1) * T(i + 1); });
  }

  template <class F>
  static V filled(F f) {
    V x{};
    for (int i = 0; i < W; ++i) set_lane(x, i, T(f(i)));
    return x;
  }
  template <class F>
  static void expect_lanes(const V& x, F expected) {
    for (int i = 0; i < W; ++i) EXPECT_EQ(lane(x, i), T(expected(i))) << "lane " << i;
  }
};

// The last two are wider than any register: they are made of halves everywhere.
using PackTypes = ::testing::Types<float, double, Pack<float, 4>, Pack<double, 4>, Pack<double, 2>,
                                   Lanes<float>, Lanes<double>, Pack<float, 32>, Pack<double, 16>>;
TYPED_TEST_SUITE(PackTest, PackTypes);

TYPED_TEST(PackTest, ArithmeticIsThatOfTheLanes) {
  using V = TypeParam;
  using T = Scalar<V>;
  const V a = this->first(), b = this->second(), c = this->third();
  auto x = [&](int i) { return lane(a, i); };
  auto y = [&](int i) { return lane(b, i); };
  auto z = [&](int i) { return lane(c, i); };
  this->expect_lanes(a + b, [&](int i) { return x(i) + y(i); });
  this->expect_lanes(a - b, [&](int i) { return x(i) - y(i); });
  this->expect_lanes(a * b, [&](int i) { return x(i) * y(i); });
  this->expect_lanes(a / c, [&](int i) { return x(i) / z(i); });
  this->expect_lanes(-a, [&](int i) { return -x(i); });
  this->expect_lanes(a + T(2), [&](int i) { return x(i) + T(2); });
  this->expect_lanes(T(2) - a, [&](int i) { return T(2) - x(i); });
  this->expect_lanes(a * T(3), [&](int i) { return x(i) * T(3); });
  this->expect_lanes(T(3) / c, [&](int i) { return T(3) / z(i); });
  this->expect_lanes(fma(a, b, c), [&](int i) { return std::fma(x(i), y(i), z(i)); });
}

TYPED_TEST(PackTest, FunctionsAreThoseOfTheLanes) {
  using V = TypeParam;
  const V a = this->first(), b = this->second(), c = this->third();
  this->expect_lanes(min(a, b), [&](int i) { return std::min(lane(a, i), lane(b, i)); });
  this->expect_lanes(max(a, b), [&](int i) { return std::max(lane(a, i), lane(b, i)); });
  this->expect_lanes(abs(a), [&](int i) { return std::abs(lane(a, i)); });
  this->expect_lanes(floor(a), [&](int i) { return std::floor(lane(a, i)); });
  this->expect_lanes(sqrt(c), [&](int i) { return std::sqrt(lane(c, i)); });
  for (int i = 0; i < lanes_of<V>; ++i) {
    EXPECT_LE(testing::ulps(lane(rsqrt(c), i), 1 / std::sqrt((long double)lane(c, i))), 2);
    EXPECT_LE(testing::ulps(lane(rcp(c), i), 1 / (long double)lane(c, i)), 2);
  }
  this->expect_lanes(from_bits(to_bits(a)), [&](int i) { return lane(a, i); });
  const auto whole = to_int(a);
  for (int i = 0; i < lanes_of<V>; ++i) {
    if constexpr (lanes_of<V> == 1) {
      EXPECT_EQ(whole, int(std::trunc(a)));
    } else {
      EXPECT_EQ(lane(whole, i), int(std::trunc(lane(a, i))));
    }
  }
}

TYPED_TEST(PackTest, MasksChooseLanes) {
  using V = TypeParam;
  using T = Scalar<V>;
  const V a = this->first(), b = this->second();
  for (int i = 0; i < lanes_of<V>; ++i) {
    const T x = lane(a, i), y = lane(b, i);
    EXPECT_EQ(lane(a < b, i), x < y);
    EXPECT_EQ(lane(a <= b, i), x <= y);
    EXPECT_EQ(lane(a > b, i), x > y);
    EXPECT_EQ(lane(a >= b, i), x >= y);
    EXPECT_EQ(lane(a == b, i), x == y);
    EXPECT_EQ(lane((a < b) & (a > T(0)), i), x < y && x > 0);
    EXPECT_EQ(lane((a < b) | (a > T(0)), i), x < y || x > 0);
    EXPECT_EQ(lane(!(a < b), i), !(x < y));
    EXPECT_EQ(lane(select(a < b, a, b), i), x < y ? x : y);
    EXPECT_EQ(lane(select(a < b, T(7), b), i), x < y ? T(7) : y);
    EXPECT_EQ(lane(select(a < b, a, T(7)), i), x < y ? x : T(7));
  }
}

TYPED_TEST(PackTest, AnyAllAndFirstLanes) {
  using V = TypeParam;
  using T = Scalar<V>;
  constexpr int W = lanes_of<V>;
  for (int one = 0; one < W; ++one) {
    V x = broadcast<V>(T(0));
    EXPECT_FALSE(any(x > T(0)));
    EXPECT_TRUE(all(x == T(0)));
    set_lane(x, one, T(1));
    EXPECT_TRUE(any(x > T(0)));
    EXPECT_FALSE(all(x == T(0)));
  }
  for (int n = 0; n <= W; ++n) {
    for (int i = 0; i < W; ++i) EXPECT_EQ(lane(first_lanes<V>(n), i), i < n);
  }
}

TYPED_TEST(PackTest, LoadAndStoreKeepTheOrder) {
  using V = TypeParam;
  using T = Scalar<V>;
  constexpr int W = lanes_of<V>;
  alignas(64) T memory[2 * W], copy[2 * W] = {};
  for (int i = 0; i < 2 * W; ++i) memory[i] = T(i) + T(0.5);
  store(copy, load<V>(memory));
  store(copy + W, load<V>(memory + W));
  for (int i = 0; i < 2 * W; ++i) EXPECT_EQ(copy[i], memory[i]);
}

TEST(Pack, LanesAreSixtyFourBytes) {
  EXPECT_EQ(sizeof(Lanes<float>), 64u);
  EXPECT_EQ(sizeof(Lanes<double>), 64u);
  EXPECT_EQ(alignof(Lanes<double>), 64u);
  EXPECT_EQ(lanes_of<Lanes<float>>, 16);
  EXPECT_EQ(lanes_of<double>, 1);
}

}  // namespace
}  // namespace scree
