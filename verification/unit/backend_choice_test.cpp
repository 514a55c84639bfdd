// SPDX-License-Identifier: Apache-2.0
//
// --backend on a machine without a GPU. (Where one works these tests have nothing to say.)
#include <gtest/gtest.h>

#include "app/backend_choice.hpp"
#include "solver/base/error.hpp"
#include "solver/device/gpus.hpp"

namespace scree::testing {
namespace {

class BackendChoiceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!find_gpus().gpus.empty()) GTEST_SKIP() << "this machine has a GPU";
  }
};

TEST_F(BackendChoiceTest, CpuAsksForNoDevice) {
  const BackendChoice choice = choose_backend("cpu");
  EXPECT_EQ(choice.name, "cpu");
  EXPECT_EQ(choice.device, nullptr);
  EXPECT_EQ(backend_text(choice), "cpu");
}

TEST_F(BackendChoiceTest, AutoGoesOnWithTheProcessorAndSaysWhy) {
  const BackendChoice choice = choose_backend("auto");
  EXPECT_EQ(choice.name, "cpu");
  EXPECT_EQ(choice.device, nullptr);
  // A build without CUDA has looked for nothing, and says nothing.
  EXPECT_EQ(choice.note.empty(), !find_gpus().compiled) << choice.note;
}

TEST_F(BackendChoiceTest, CudaIsRefusedWithTheReason) {
  const std::string reason = find_gpus().problem;
  ASSERT_FALSE(reason.empty());
  try {
    choose_backend("cuda");
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_EQ(std::string(error.what()),
              "--backend cuda: no GPU: " + reason + "; use --backend cpu");
  }
}

TEST(BackendOfTheProcessorAlone, CudaIsRefusedWithTheKeyInTheWay) {
  EXPECT_EQ(choose_backend("auto", {}, "[coupling]").device, nullptr);
  try {
    choose_backend("cuda", {}, "[coupling]");
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(),
                 "--backend cuda: [coupling] is computed by the processor; use --backend cpu");
  }
}

TEST(MemoryNeedText, GivesBytesAParticleAndBothTotals) {
  EXPECT_EQ(memory_need_text({1'000'000, 312'000'000, 84'900'000'000}),
            "GPU memory: 312 bytes a particle, at least 0.31 of 84.90 GB free");
}

}  // namespace
}  // namespace scree::testing
