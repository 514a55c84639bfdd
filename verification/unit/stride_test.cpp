// SPDX-License-Identifier: Apache-2.0
//
// How long strides of pore water are.
#include <gtest/gtest.h>

#include "solver/simulation/stride.hpp"

namespace scree {
namespace {

/// Steps of the first stride where particles move by `move` cells a step.
int length(Stride stride, double move) {
  for (int n = 1;; ++n) {
    stride.plan(move);
    const bool ends = stride.ends();
    stride.note(move);
    EXPECT_EQ(stride.begins(), ends);
    if (ends) return n;
  }
}

TEST(Stride, HasSingleStepsUnlessToldOtherwise) {
  EXPECT_EQ(length(Stride(), 0), 1);
  EXPECT_EQ(length(Stride(1, 0.05), 0), 1);
  EXPECT_EQ(length(Stride(64, 0), 1e-6), 1);
  EXPECT_EQ(Stride(1, 0.05).most_drift(), 0);
}

TEST(Stride, EndsAfterSoManySteps) {
  EXPECT_EQ(length(Stride(64, 0.005), 0), 64);
  EXPECT_EQ(length(Stride(3, 0.005), 1e-4), 3);
}

/// The step that would lead beyond is not of it.
TEST(Stride, EndsBeforeAParticleIsTooFar) {
  EXPECT_EQ(length(Stride(64, 0.005), 0.001), 5);
  EXPECT_EQ(length(Stride(64, 0.005), 0.0013), 3);
  EXPECT_EQ(length(Stride(64, 0.005), 0.1), 1);
}

TEST(Stride, GoesOnFromACheckpoint) {
  Stride stride(64, 0.005), resumed(64, 0.005);
  for (int n = 0; n < 3; ++n) {
    stride.plan(0.001);
    stride.note(0.001);
  }
  resumed.resume(stride.steps(), stride.drift());
  EXPECT_FALSE(resumed.begins());
  EXPECT_EQ(length(resumed, 0.001), 2);
}

}  // namespace
}  // namespace scree
