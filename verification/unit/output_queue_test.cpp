// SPDX-License-Identifier: Apache-2.0
#include "app/output_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <numeric>
#include <vector>

#include "solver/base/error.hpp"

namespace scree {
namespace {

/// Jobs stop at a gate until it opens, as on a slow disk.
class Gate {
 public:
  OutputQueue::Job job() const {
    return [opened = opened_] { opened.wait(); };
  }
  void open() { open_.set_value(); }

 private:
  std::promise<void> open_;
  std::shared_future<void> opened_ = open_.get_future().share();
};

/// True if `call` does not return within 50 ms: enough for a call that does not wait. A machine so
/// busy that such a call takes longer cannot make a test fail, for only waiting is expected.
bool waits(std::future<void>& call) {
  return call.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout;
}

TEST(OutputThread, KeepsTheOrder) {
  OutputQueue queue;
  std::vector<int> done;
  for (int i = 0; i < 1000; ++i) {
    queue.add(i % 7 == 0 ? JobSize::large : JobSize::small, [&done, i] { done.push_back(i); });
  }
  queue.drain();
  std::vector<int> expected(1000);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(done, expected);
}

TEST(OutputThread, ASlowDiskBoundsTheLargeJobs) {
  Gate gate;
  OutputQueue queue;
  for (int i = 0; i < OutputQueue::max_large; ++i) queue.add(JobSize::large, gate.job());
  queue.add(JobSize::small, [] {});  // goes on: only large ones are too many
  auto third = std::async(std::launch::async, [&] { queue.wait_for_room(JobSize::large); });
  EXPECT_TRUE(waits(third));
  gate.open();
  third.get();
}

TEST(OutputThread, ASlowDiskBoundsTheSmallJobs) {
  Gate gate;
  OutputQueue queue;
  queue.add(JobSize::large, gate.job());
  for (int i = 0; i < OutputQueue::max_small; ++i) queue.add(JobSize::small, [] {});
  auto more = std::async(std::launch::async, [&] { queue.add(JobSize::small, [] {}); });
  EXPECT_TRUE(waits(more));
  gate.open();
  more.get();
}

TEST(OutputThread, NeverHoldsMoreThanTwoLargeJobs) {
  std::atomic<int> alive = 0;
  int most = 0;
  struct Data {  // counts itself, as a copy of all particles takes memory
    explicit Data(std::atomic<int>& alive) : count(alive) { ++count; }
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;
    ~Data() { --count; }
    std::atomic<int>& count;
  };
  {
    OutputQueue queue;
    for (int i = 0; i < 200; ++i) {
      queue.wait_for_room(JobSize::large);
      auto data = std::make_shared<Data>(alive);
      most = std::max(most, alive.load());
      queue.add(JobSize::large, [data = std::move(data)] {});
    }
  }
  EXPECT_EQ(alive, 0);
  EXPECT_LE(most, OutputQueue::max_large);
}

TEST(OutputThread, DrainWaitsForTheLastJob) {
  OutputQueue queue;
  Gate gate;
  bool done = false;
  queue.add(JobSize::small, gate.job());
  queue.add(JobSize::small, [&done] { done = true; });
  auto drained = std::async(std::launch::async, [&] { queue.drain(); });
  EXPECT_TRUE(waits(drained));
  gate.open();
  drained.get();
  EXPECT_TRUE(done);
}

TEST(OutputThread, TheEndDoesWhatIsLeft) {
  int done = 0;
  {
    OutputQueue queue;
    for (int i = 0; i < 100; ++i) queue.add(JobSize::small, [&done] { ++done; });
  }
  EXPECT_EQ(done, 100);
}

TEST(OutputThread, NothingIsDoneAfterAFailureAndTheCallerLearnsOfIt) {
  const auto fault = [](auto call) -> std::string {
    try {
      call();
    } catch (const RunFault& fault) {
      return fault.what();
    }
    return "none";
  };
  bool later = false;
  OutputQueue queue;
  Gate gate;
  EXPECT_EQ(fault([&] { queue.check(); }), "none");
  queue.add(JobSize::small, gate.job());
  queue.add(JobSize::large, [] { throw RunFault("cannot write frame: disk full"); });
  queue.add(JobSize::large, [&later] { later = true; });
  gate.open();
  queue.drain();
  for (int i = 0; i < 2; ++i) {  // it stays so
    EXPECT_EQ(fault([&] { queue.check(); }), "cannot write frame: disk full");
    EXPECT_EQ(fault([&] { queue.wait_for_room(JobSize::large); }), "cannot write frame: disk full");
    EXPECT_EQ(fault([&] { queue.add(JobSize::small, [&later] { later = true; }); }),
              "cannot write frame: disk full");
  }
  queue.drain();
  EXPECT_FALSE(later);
}

TEST(OutputThread, AFailureWakesACallerThatWaitsForRoom) {
  OutputQueue queue;
  Gate gate;
  queue.add(JobSize::large, gate.job());
  queue.add(JobSize::large, [] { throw std::bad_alloc(); });
  auto third = std::async(std::launch::async, [&] {
    queue.wait_for_room(JobSize::large);  // room for one when the gate opens
    queue.add(JobSize::large, [] {});
    queue.drain();
    queue.check();
  });
  gate.open();
  EXPECT_THROW(third.get(), std::bad_alloc);
}

}  // namespace
}  // namespace scree
