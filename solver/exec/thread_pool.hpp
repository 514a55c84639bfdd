// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace scree {

/// A fixed team of threads that shares out index ranges.
///
/// Each thread has a part of the range of its own, the same in every range of that length: indices
/// that are near in space are near in number, and what a thread wrote is in its cache. Who has done
/// its part takes from those of others. So which thread runs an index is left to chance; callers
/// must write results by index (or in an order fixed by colours), so that they do not depend on it.
///
/// A step has a dozen ranges, and to wake a sleeping thread can take as long as a short range. So a
/// thread that has nothing to do looks out for the next range for some microseconds before it goes
/// to sleep, unless there are more threads than processors.
class ThreadPool {
 public:
  /// threads >= 1; 1 runs everything on the caller.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls f(index, thread) for every index in [0, count), `chunk` one after the other at a time;
  /// returns when all are done. The first exception is rethrown here.
  void for_each(std::int64_t count, const std::function<void(std::int64_t, int)>& f,
                std::int64_t chunk = 1);

 private:
  /// A thread's part of the range that is not taken yet; in cache lines of its own.
  struct alignas(64) Part {
    std::atomic<std::int64_t> next{0};
    std::int64_t end = 0;
  };

  void work(int thread);
  void run_chunks(int thread);
  void run_part(Part& part, int thread);
  template <class Condition>
  bool comes_soon(const Condition& condition) const;

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable start_;
  std::condition_variable done_;
  std::atomic<std::uint64_t> generation_{0};
  std::atomic<int> running_{0};
  std::atomic<bool> stop_{false};
  int looks_ = 0;  ///< for something to do before going to sleep
  const std::function<void(std::int64_t, int)>* job_ = nullptr;
  std::int64_t chunk_ = 1;
  std::vector<Part> parts_;  ///< one a thread
  std::exception_ptr failure_;
};

}  // namespace scree
