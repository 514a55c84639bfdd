// SPDX-License-Identifier: Apache-2.0
// Verdicts: what passes, what fails, and that what cannot be judged fails.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "verification/suite/judge.hpp"
#include "verification/suite/peers.hpp"

namespace scree::verify {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A case of one series "a" with errors on 8, 16, 32, ... cells and one "b" with other errors.
CaseResult two_series(const std::vector<double>& a, const std::vector<double>& b) {
  CaseResult result;
  result.sweep.series = {{"a", "cells", {}, {}, false}, {"b", "cells", {}, {}, false}};
  for (std::size_t s = 0; s < 2; ++s) {
    double cells = 8;
    for (const double error : s == 0 ? a : b) {
      RunResult& run = result.runs.emplace_back();
      run.plan.series = s;
      run.plan.series_name = result.sweep.series[s].name;
      run.plan.value = cells;
      run.plan.size = 1 / cells;
      run.measured.value("error", error, 1.0);
      cells *= 2;
    }
  }
  return result;
}

Expectation expectation(CheckKind kind, std::vector<double> limits) {
  Expectation e;
  e.quantity = "error";
  e.series = {"a"};
  e.kind = kind;
  e.limits = std::move(limits);
  return e;
}

bool verdict(CaseResult result, const Expectation& e) {
  result.text.expectations = {e};
  judge(result);
  EXPECT_EQ(result.checks.size(), 1u);
  return result.passed;
}

TEST(CaseJudge, Bounds) {
  const CaseResult result = two_series({0.9, 1.1}, {});
  EXPECT_TRUE(verdict(result, expectation(CheckKind::at_most, {1.1})));
  EXPECT_FALSE(verdict(result, expectation(CheckKind::at_most, {1.0})));
  EXPECT_TRUE(verdict(result, expectation(CheckKind::at_least, {0.9})));
  EXPECT_FALSE(verdict(result, expectation(CheckKind::at_least, {1.0})));
  EXPECT_TRUE(verdict(result, expectation(CheckKind::between, {0.9, 1.1})));
  EXPECT_FALSE(verdict(result, expectation(CheckKind::between, {0.95, 1.1})));
  EXPECT_TRUE(verdict(result, expectation(CheckKind::within, {0.11})));
  EXPECT_FALSE(verdict(result, expectation(CheckKind::within, {0.09})));
}

TEST(CaseJudge, ALimitForEachRun) {
  Expectation e = expectation(CheckKind::at_most, {1.0, 1.2});
  e.at = {8, 16};
  EXPECT_TRUE(verdict(two_series({0.9, 1.1}, {}), e));
  e.limits = {1.2, 1.0};
  EXPECT_FALSE(verdict(two_series({0.9, 1.1}, {}), e));
}

TEST(CaseJudge, OrderOfTheTwoFinest) {
  const Expectation e = expectation(CheckKind::order, {1.9, 2.1});
  EXPECT_TRUE(verdict(two_series({7, 4, 1}, {}), e));
  EXPECT_FALSE(verdict(two_series({16, 4, 2}, {}), e));
  EXPECT_FALSE(verdict(two_series({4}, {}), e)) << "one run has no order";
  EXPECT_FALSE(verdict(two_series({4, 0}, {}), e));
}

TEST(CaseJudge, OnlyAnAssertedOrderIsWorkedOut) {
  CaseResult result = two_series({4, 1}, {});
  result.text.expectations = {expectation(CheckKind::order, {1.9, 2.1}),
                              expectation(CheckKind::at_most, {4.0})};
  judge(result);
  ASSERT_EQ(result.checks.size(), 2u);
  EXPECT_EQ(result.checks[0].order, 2);
  EXPECT_FALSE(result.checks[1].order);
}

TEST(CaseJudge, AgainstAnotherSeries) {
  Expectation e = expectation(CheckKind::at_most_times, {0.5});
  e.than = "b";
  EXPECT_TRUE(verdict(two_series({1, 2}, {2, 4}), e));
  EXPECT_FALSE(verdict(two_series({1, 2.1}, {2, 4}), e));
  EXPECT_FALSE(verdict(two_series({1, 2}, {2}), e)) << "nothing to compare with";
  e.kind = CheckKind::at_least_times;
  EXPECT_FALSE(verdict(two_series({0.9}, {2}), e));
}

TEST(CaseJudge, WhatIsNoNumberFails) {
  for (const CheckKind kind : {CheckKind::at_most, CheckKind::at_least, CheckKind::within})
    EXPECT_FALSE(verdict(two_series({nan}, {}), expectation(kind, {1.0})));
  Expectation other = expectation(CheckKind::at_most, {1.0});
  other.quantity = "another";
  EXPECT_FALSE(verdict(two_series({0.5}, {}), other));
}

TEST(CaseJudge, AFailedRunFailsTheCaseUnlessItMay) {
  CaseResult result = two_series({0.5}, {0.5});
  result.runs[1].fault = "step 3: blew up";
  result.runs[1].measured = {};
  EXPECT_FALSE(verdict(result, expectation(CheckKind::at_most, {1.0})));
  result.runs[1].plan.may_fail = true;
  EXPECT_TRUE(verdict(result, expectation(CheckKind::at_most, {1.0})));
  Expectation worse = expectation(CheckKind::at_least_times, {10.0});
  worse.series = {"b"};
  worse.than = "a";
  EXPECT_TRUE(verdict(result, worse)) << "a baseline that blew up is worse";
}

TEST(CasePeers, EveryRunThatTheOtherCodeHasIsARow) {
  std::vector<CaseResult> results{two_series({0.02, 0.01}, {0.4})};
  EXPECT_EQ(peers_text(results), "");
  EXPECT_EQ(peers_html(results), "");
  results[0].name = "column";
  results[0].text.peers = {{"other", "error", "a", {8, 16, 32}, {0.04, 0.005, 0.001}, "a paper"},
                           {"other", "error", "b", {8}, {0.4}, "a paper"}};
  const std::vector<PeerRow> rows = peer_rows(results);
  ASSERT_EQ(rows.size(), 3u) << "no run of 32 cells";
  EXPECT_EQ(peer_ratio(rows[0]), "2 times smaller");
  EXPECT_EQ(peer_ratio(rows[1]), "2 times larger");
  EXPECT_EQ(peer_ratio(rows[2]), "equal");
  EXPECT_NE(peers_text(results).find("other       0.04    0.02, 2 times smaller"),
            std::string::npos)
      << peers_text(results);
  EXPECT_NE(peers_html(results).find("a paper"), std::string::npos);
  results[0].runs[0].measured.quantities.clear();
  EXPECT_EQ(peer_rows(results).size(), 2u) << "a run that failed has nothing to compare";
}

}  // namespace
}  // namespace scree::verify
