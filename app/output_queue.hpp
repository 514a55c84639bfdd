// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace scree {

/// What a job holds in memory: a copy of all particles or nodes, or a few numbers.
enum class JobSize { large, small };

/// Jobs that a thread of its own does one after the other, in the order in which they came.
///
/// Memory is bounded: at most two large jobs and 256 small ones are in the queue at a time, the one
/// being done included; whoever adds more waits. The first job that throws is the last one done:
/// those after it are dropped, and the exception is rethrown to the caller by add() and check(),
/// as often as they are called. One caller at a time.
class OutputQueue {
 public:
  using Job = std::function<void()>;

  static constexpr int max_large = 2;
  static constexpr int max_small = 256;

  OutputQueue();
  OutputQueue(const OutputQueue&) = delete;
  OutputQueue& operator=(const OutputQueue&) = delete;
  ~OutputQueue();  ///< does the jobs that are left

  /// Returns when a job of this size could be added without waiting. To be called before the data
  /// of a large job are copied, so that the copies are bounded too. Throws what a job threw.
  void wait_for_room(JobSize size);

  /// Waits for room and adds the job. Throws what a former job threw.
  void add(JobSize size, Job job);

  /// Returns when no job is left. Throws nothing.
  void drain();

  /// Throws what a job threw, if one did. Does not wait and costs next to nothing.
  void check();

 private:
  struct Entry {
    JobSize size;
    Job job;
  };

  int& count(JobSize size) { return size == JobSize::large ? large_ : small_; }
  bool has_room(JobSize size) {
    return count(size) < (size == JobSize::large ? max_large : max_small);
  }
  void wait_for_room(std::unique_lock<std::mutex>& lock, JobSize size);
  void work();
  void run(const Entry& entry);

  std::mutex mutex_;
  std::condition_variable added_, done_;
  std::deque<Entry> waiting_;
  int large_ = 0, small_ = 0;  ///< jobs not done, waiting or under way
  bool stop_ = false;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;  ///< guarded by the mutex
  std::thread thread_;          ///< last, so that it starts when all else is there
};

}  // namespace scree
