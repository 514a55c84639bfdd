// SPDX-License-Identifier: Apache-2.0
// Every law in SIMD lanes against the same law as a scalar.
#include <gtest/gtest.h>

#include "verification/conformance/checks.hpp"
#include "verification/support/effort.hpp"

namespace scree::testing {
namespace {

class EveryLawInLanes : public ::testing::TestWithParam<std::string> {
 protected:
  /// Largest error of all widths and samples.
  template <class T>
  Worst worst_of_widths() {
    Worst worst;
    const Family& family = find_family(GetParam());
    const auto laws = family.laws();
    for (std::size_t i = 0; i < laws.size(); ++i) {
      const auto lanes = make_lane_law<T>(family.name, i);
      for (const int width : {1, 4, 8, 16}) {
        MatrixSource source{22};
        worst.add(lanes_against_scalars<T>(laws[i], *lanes, width, source, effort(2000) / width));
      }
    }
    return worst;
  }
};
INSTANTIATE_TEST_SUITE_P(List, EveryLawInLanes, ::testing::ValuesIn(family_names()),
                         [](const auto& info) { return info.param; });

// Lanes and scalars run the same operations and differ only by the compiler's choice of fused
// multiply-adds: roundings amplified by products of stretches up to 3, and in rates of strain by
// 1/dt = 100. 5e-13 are 2000 units in the last place, 3e-4 as many in float.
TEST_P(EveryLawInLanes, EqualScalarsInDouble) {
  const Worst worst = worst_of_widths<double>();
  EXPECT_LE(worst.error, 5e-13);
  EXPECT_GT(worst.samples, 500);
}

TEST_P(EveryLawInLanes, EqualScalarsInFloat) {
  const Worst worst = worst_of_widths<float>();
  EXPECT_LE(worst.error, 3e-4);
  EXPECT_GT(worst.samples, 500);
}

}  // namespace
}  // namespace scree::testing
