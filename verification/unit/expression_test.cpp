// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/error.hpp"

namespace scree {
namespace {

constexpr double rounding = 1e-15;  // a few operations on numbers near 1

TEST(Expression, ComputesWithVariablesAndPi) {
  const Expression ramp("-9.81*min(t/2,1)", {"t"});
  for (const double t : {0.0, 0.5, 2.0, 7.0}) {
    EXPECT_NEAR(ramp(&t), -9.81 * std::min(t / 2, 1.0), 10 * rounding) << t;
  }
  const Expression wave("0.1*sin(pi*x) + y^2", {"x", "y"});
  const double x[2] = {0.3, 0.7};
  EXPECT_NEAR(wave(x), 0.1 * std::sin(std::numbers::pi * x[0]) + x[1] * x[1], rounding);
}

TEST(Expression, KnowsItsFunctions) {
  const double t = 0.37;
  const auto value = [&](const char* text) { return Expression(text, {"t"})(&t); };
  EXPECT_NEAR(value("exp(-t)*cos(2*t)"), std::exp(-t) * std::cos(2 * t), rounding);
  EXPECT_NEAR(value("log(t)"), std::log(t), rounding);  // natural, as the documentation says
  EXPECT_NEAR(value("ln(t)"), std::log(t), rounding);
  EXPECT_NEAR(value("log10(t)"), std::log10(t), rounding);
  EXPECT_NEAR(value("log2(t)"), std::log2(t), 2 * rounding);
  EXPECT_NEAR(value("atan2(t,2)"), std::atan2(t, 2), rounding);
  EXPECT_NEAR(value("tanh(t)"), std::tanh(t), rounding);
  EXPECT_NEAR(value("t < 1 ? 2 : 3"), 2, 0);
  EXPECT_NEAR(value("t > 1 || t == 5 ? 2 : 3"), 3, 0);
  EXPECT_NEAR(value("max(1,2,t)"), 2, 0);
}

TEST(Expression, KnowsWhetherItIsConstant) {
  EXPECT_TRUE(Expression("2*pi", {"t"}).constant());
  EXPECT_FALSE(Expression("2*t", {"t"}).constant());
}

TEST(Expression, CopiesAreIndependent) {
  const Expression original("x + 1", {"x"});
  Expression copy = original;
  const double one = 1, two = 2;
  EXPECT_EQ(copy(&two), 3);
  EXPECT_EQ(original(&one), 2);
  copy = Expression("x * 10", {"x"});
  EXPECT_EQ(copy(&two), 20);
  EXPECT_EQ(original(&two), 3);
}

struct Fault {
  const char* text;
  const char* sentence;
};

class ExpressionFaults : public testing::TestWithParam<Fault> {};

TEST_P(ExpressionFaults, AreReportedWithTheirPlace) {
  const auto fault = Expression::fault(GetParam().text, {"x", "y", "t"});
  ASSERT_TRUE(fault);
  EXPECT_EQ(*fault, GetParam().sentence);
  EXPECT_THROW(Expression(GetParam().text, {"x", "y", "t"}), UserError);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, ExpressionFaults,
    testing::Values(
        Fault{"2*z", "is no expression: unknown name \"z\" at character 3"},
        Fault{"mim(t,1)",
              "is no expression: unknown name \"mim\" at character 1 (did you mean \"min\"?)"},
        Fault{"x +", "is no expression: the expression ends too early at character 4"},
        Fault{"sin(x", "is no expression: missing \")\" at character 6"},
        Fault{"x)", "is no expression: unexpected \")\" at character 2"},
        Fault{"atan2(x)", "is no expression: too few arguments for a function at character 8"},
        Fault{"t = 3", "is no expression: an assignment \"=\" at character 3; to compare write =="},
        Fault{"1,2", "is no expression: a comma outside of a function's arguments"},
        Fault{"", "is no expression: the expression is empty"}));

TEST(Expression, LibrarySentencesHaveNoFullStop) {
  std::string text = "1";
  while (text.size() < 50000) text += "+1";  // longer than muParser takes
  EXPECT_EQ(Expression::fault(text, {}), "is no expression: expression too long");
}

TEST(Expression, ComparisonsAreNoAssignments) {
  for (const char* text : {"x == 1", "x <= 1", "x >= 1", "x != 1"}) {
    EXPECT_FALSE(Expression::fault(text, {"x"})) << text;
  }
}

}  // namespace
}  // namespace scree
