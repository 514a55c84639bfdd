// SPDX-License-Identifier: Apache-2.0
#include "solver/exec/flush_subnormals.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace scree {
namespace {

#ifdef __SSE2__
TEST(FlushSubnormals, OnlyWhileItLives) {
  volatile float normal = std::numeric_limits<float>::min();
  volatile float half = 0.5F;
  const auto product = [&] { return float(normal * half); };
  EXPECT_GT(product(), 0.0F);
  {
    const FlushSubnormals flush;
    EXPECT_EQ(product(), 0.0F);
    const FlushSubnormals nested;
    EXPECT_EQ(product(), 0.0F);
  }
  EXPECT_GT(product(), 0.0F);
}
#endif

}  // namespace
}  // namespace scree
