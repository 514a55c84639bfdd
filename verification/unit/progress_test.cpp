// SPDX-License-Identifier: Apache-2.0
#include "app/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace scree {
namespace {

/// Output and wall clock in the hands of the test.
class ProgressTest : public testing::Test {
 public:
  ~ProgressTest() override { std::fclose(file_); }

 protected:
  Progress make(ProgressStyle style, double start = 0) {
    return Progress(file_, style, start, 2.0, [this] { return now_; });
  }
  std::string written() const {
    std::string text(static_cast<std::size_t>(std::ftell(file_)), '\0');
    std::rewind(file_);
    EXPECT_EQ(std::fread(text.data(), 1, text.size(), file_), text.size());
    return text;
  }

  std::FILE* file_ = std::tmpfile();
  double now_ = 100;
};

TEST_F(ProgressTest, ALineSaysItAll) {
  Progress progress = make(ProgressStyle::lines);
  now_ += 10;  // 0.5 of 2 s in 10 s: 30 s are left; 4e6 updates in 10 s
  progress.update({0.5, 123, 1e-4, 4e6});
  EXPECT_EQ(written(),
            " 25 %  t 0.5 / 2 s  step 123  dt 1.00e-04 s  4.00e+05 updates/s  ETA 0:30\n");
}

TEST_F(ProgressTest, LinesComeAtTenthsAndMinutes) {
  Progress progress = make(ProgressStyle::lines);
  for (int i = 1; i <= 100; ++i) {  // 5 s a percent: a tenth is reached every 50 s
    now_ += 5;
    progress.update({0.02 * i, i, 1e-4, 0});
  }
  std::string text = written();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
}

TEST_F(ProgressTest, AFastRunWritesNoLines) {
  Progress progress = make(ProgressStyle::lines);
  for (int i = 1; i <= 100; ++i) {
    now_ += 0.009;  // done in 0.9 s
    progress.update({0.02 * i, i, 1e-4, 0});
  }
  progress.finish({2, 100, 1e-4, 0});
  EXPECT_EQ(written(), "");
}

TEST_F(ProgressTest, TheBarIsRedrawnInPlace) {
  Progress progress = make(ProgressStyle::bar);
  now_ += 0.05;
  progress.update({0.1, 1, 1e-4, 0});  // too early to draw
  now_ += 0.1;
  progress.update({1.0, 2, 1e-4, 0});
  progress.finish({2.0, 3, 1e-4, 0});
  const std::string text = written();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.find("\r[############............]  50 %"), 0u);
  EXPECT_NE(text.find("\r[########################] 100 %"), std::string::npos);
}

TEST_F(ProgressTest, AContinuedRunCountsFromItsStart) {
  Progress progress = make(ProgressStyle::lines, 1.0);
  now_ += 10;  // 0.5 s done in 10 s since t = 1 s, 0.5 s left
  progress.update({1.5, 5, 1e-4, 1e6});
  EXPECT_NE(written().find("ETA 0:10"), std::string::npos);
}

TEST_F(ProgressTest, QuietIsQuiet) {
  Progress progress = make(ProgressStyle::none);
  now_ += 1000;
  progress.update({1.0, 1, 1e-4, 0});
  progress.finish({2.0, 1, 1e-4, 0});
  EXPECT_EQ(written(), "");
}

TEST(ClockText, MinutesAndHours) {
  EXPECT_EQ(clock_text(0.4), "0:00");
  EXPECT_EQ(clock_text(7), "0:07");
  EXPECT_EQ(clock_text(12 * 60 + 34), "12:34");
  EXPECT_EQ(clock_text(3 * 3600 + 5 * 60), "3:05:00");
  EXPECT_EQ(clock_text(1e300), "-");
}

}  // namespace
}  // namespace scree
