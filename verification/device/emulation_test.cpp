// SPDX-License-Identifier: Apache-2.0
//
// The emulation finds the defects of kernels that it promises to find.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "solver/device/launch.cuh"

namespace scree::testing {
namespace {

struct Room {
  int value[64];
};

/// Threads of the block, in reverse: each reads what another has written.
void reversed(int* out) {
  SCREE_SHARED(Room, room);
  room.value[threadIdx.x] = int(threadIdx.x + 100 * blockIdx.x);
  device::barrier();
  out[element()] = room.value[device::threads() - 1 - device::thread()];
}

void without_barrier(int* out) {
  SCREE_SHARED(Room, room);
  room.value[threadIdx.x] = int(threadIdx.x);
  out[element()] = room.value[(device::thread() + 1) % device::threads()];
}

void some_wait() {
  if (threadIdx.x < 40) device::barrier();
}

void wait_elsewhere() {
  if (threadIdx.x % 2 == 0) {
    device::barrier();
  } else {
    device::barrier();
  }
}

void part_of_warp_sums(double* out) {
  double x = 1;
  if (threadIdx.x < 10) x = __shfl_xor_sync(0xffffffffu, x, 1);
  *out = x;
}

struct Number {
  double value[2];
};

void reads_before_writing(double* out) {
  SCREE_SHARED(Number, number);
  if (threadIdx.x == 0) *out = number.value[1];
}

void writes_beyond(int index) {
  SCREE_SHARED(Number, number);
  double* p = number.value;
  if (threadIdx.x == 0) p[index] = 1;
}

struct Sums {
  double value[64];
};

void sum_and_raise(double* sum, float* largest, int* count) {
  SCREE_SHARED(Sums, room);
  const double total = device::block_sum(double(threadIdx.x), room.value);
  if (threadIdx.x == 0) *sum = total;
  device::raise(largest, float((threadIdx.x * 7) % 64));
  device::add(count, 1);
}

template <class F>
std::string defect(const F& launch) {
  try {
    launch();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "none";
}

TEST(Emulation, threads_meet_at_barriers_in_any_order) {
  for (const auto order :
       {emulation::Order::forward, emulation::Order::backward, emulation::Order::threads}) {
    emulation::set_order(order);
    std::vector<int> out(128, -1);
    launch("reversed", reversed, 2, 64, out.data());
    for (int b = 0; b < 2; ++b) {
      for (int t = 0; t < 64; ++t) EXPECT_EQ(out[std::size_t(64 * b + t)], 63 - t + 100 * b);
    }
  }
  emulation::set_order(emulation::Order::forward);
}

TEST(Emulation, orders_differ_where_a_barrier_is_missing) {
  std::vector<int> forward(64);
  std::vector<int> backward(64);
  launch("without_barrier", without_barrier, 1, 64, forward.data());
  emulation::set_order(emulation::Order::backward);
  launch("without_barrier", without_barrier, 1, 64, backward.data());
  emulation::set_order(emulation::Order::forward);
  EXPECT_NE(forward, backward);
}

TEST(Emulation, divergent_barriers_are_named) {
  const std::string ended = defect([] { launch("", some_wait, 3, 64); });
  EXPECT_NE(ended.find("divergent barrier: thread 0 of block 0 waits at emulation_test.cpp:"),
            std::string::npos)
      << ended;
  EXPECT_NE(ended.find("but thread 40 has ended"), std::string::npos) << ended;
  const std::string elsewhere = defect([] { launch("", wait_elsewhere, 1, 64); });
  EXPECT_NE(elsewhere.find("but thread 1 waits at emulation_test.cpp:"), std::string::npos)
      << elsewhere;
  double x = 0;
  const std::string warp = defect([&] { launch("", part_of_warp_sums, 1, 64, &x); });
  EXPECT_NE(warp.find("waits for its warp at"), std::string::npos) << warp;
  EXPECT_NE(warp.find("but thread 10 has ended"), std::string::npos) << warp;
}

TEST(Emulation, shared_memory_starts_as_nan_and_is_guarded) {
  double x = 0;
  launch("", reads_before_writing, 1, 32, &x);
  EXPECT_TRUE(std::isnan(x));
  EXPECT_EQ(defect([] { launch("", writes_beyond, 1, 32, 1); }), "none");
#ifndef __SANITIZE_ADDRESS__
  for (const int index : {-1, 2}) {
    EXPECT_EQ(defect([&] { launch("", writes_beyond, 1, 32, index); }),
              "a kernel wrote beyond its 16 bytes of shared memory");
  }
#else
  EXPECT_DEATH(launch("", writes_beyond, 1, 32, 2), "use-after-poison");
#endif
}

TEST(Emulation, sums_and_maxima_of_a_block) {
  for (const auto order : {emulation::Order::forward, emulation::Order::threads}) {
    emulation::set_order(order);
    double sum = 0;
    float largest = 0;
    int count = 0;
    launch("", sum_and_raise, 2, 64, &sum, &largest, &count);
    EXPECT_EQ(sum, 63 * 64 / 2);
    EXPECT_EQ(largest, 63);
    EXPECT_EQ(count, 128);
  }
  emulation::set_order(emulation::Order::forward);
}

TEST(Emulation, refuses_block_sizes_that_warps_cannot_reduce) {
  EXPECT_NE(defect([] { launch("", some_wait, 1, 40); }).find("a multiple of 32"),
            std::string::npos);
}

}  // namespace
}  // namespace scree::testing
