// SPDX-License-Identifier: Apache-2.0
#include "solver/exec/thread_pool.hpp"

#include <algorithm>
#include <utility>

namespace scree {
namespace {

/// Tells the processor that a loop waits.
void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

ThreadPool::ThreadPool(int threads) : parts_(std::size_t(std::max(threads, 1))) {
  // A pause is 10 to 40 ns.
  if (unsigned(std::max(threads, 1)) <= std::thread::hardware_concurrency()) looks_ = 1000;
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

template <class Condition>
bool ThreadPool::comes_soon(const Condition& condition) const {
  for (int look = 0; look < looks_; ++look) {
    if (condition()) return true;
    pause();
  }
  return condition();
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
    chunk_ = chunk;
    for (std::int64_t t = 0; t < size(); ++t) {
      parts_[std::size_t(t)].next.store(count * t / size());
      parts_[std::size_t(t)].end = count * (t + 1) / size();
    }
    running_ = static_cast<int>(workers_.size());
    ++generation_;
  }
  start_.notify_all();
  run_chunks(0);
  const auto all_done = [this] { return running_ == 0; };
  if (!comes_soon(all_done)) {
    std::unique_lock lock(mutex_);
    done_.wait(lock, all_done);
  }
  job_ = nullptr;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::run_chunks(int thread) {
  try {
    for (int other = 0; other < size(); ++other) {
      run_part(parts_[std::size_t((thread + other) % size())], thread);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    for (Part& part : parts_) part.next.store(part.end);
  }
}

void ThreadPool::run_part(Part& part, int thread) {
  while (part.next.load() < part.end) {
    const std::int64_t begin = part.next.fetch_add(chunk_);
    const std::int64_t end = std::min(begin + chunk_, part.end);
    for (std::int64_t i = begin; i < end; ++i) (*job_)(i, thread);
  }
}

void ThreadPool::work(int thread) {
  std::uint64_t seen = 0;
  for (;;) {
    const auto has_job = [this, &seen] { return stop_ || generation_ != seen; };
    if (!comes_soon(has_job)) {
      std::unique_lock lock(mutex_);
      start_.wait(lock, has_job);
    }
    if (stop_) return;
    seen = generation_;
    run_chunks(thread);
    if (--running_ > 0) continue;
    const std::lock_guard lock(mutex_);  // or the caller might go to sleep after it was called
    done_.notify_one();
  }
}

}  // namespace scree
