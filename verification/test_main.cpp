// SPDX-License-Identifier: Apache-2.0
// The main function of every test program.
#include <gtest/gtest.h>

#ifdef SCREE_FP_TRAPS
#include <cfenv>
#endif

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
#ifdef SCREE_FP_TRAPS
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#endif
  return RUN_ALL_TESTS();
}
