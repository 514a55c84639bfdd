// SPDX-License-Identifier: Apache-2.0
#include "solver/exec/thread_pool.hpp"

#include <algorithm>
#include <utility>

namespace scree {

ThreadPool::ThreadPool(int threads) {
  for (int t = 1; t < std::max(threads, 1); ++t) workers_.emplace_back([this, t] { work(t); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::for_each(std::int64_t count, const std::function<void(std::int64_t, int)>& f,
                          std::int64_t chunk) {
  if (count <= 0) return;
  if (workers_.empty() || count <= chunk) {
    for (std::int64_t i = 0; i < count; ++i) f(i, 0);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    job_ = &f;
    count_ = count;
    chunk_ = chunk;
    next_.store(0);
    running_ = static_cast<int>(workers_.size());
    ++generation_;
  }
  start_.notify_all();
  run_chunks(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return running_ == 0; });
  job_ = nullptr;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::run_chunks(int thread) {
  try {
    for (;;) {
      const std::int64_t begin = next_.fetch_add(chunk_);
      if (begin >= count_) return;
      const std::int64_t end = std::min(begin + chunk_, count_);
      for (std::int64_t i = begin; i < end; ++i) (*job_)(i, thread);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    next_.store(count_);
  }
}

void ThreadPool::work(int thread) {
  std::uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [this, seen] { return stop_ || generation_ != seen; });
      if (stop_) return;
      seen = generation_;
    }
    run_chunks(thread);
    {
      const std::lock_guard lock(mutex_);
      --running_;
    }
    done_.notify_one();
  }
}

}  // namespace scree
