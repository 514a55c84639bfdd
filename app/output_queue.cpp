// SPDX-License-Identifier: Apache-2.0
#include "app/output_queue.hpp"

#include <utility>

namespace scree {

OutputQueue::OutputQueue() : thread_([this] { work(); }) {}

OutputQueue::~OutputQueue() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  added_.notify_one();
  thread_.join();
}

void OutputQueue::wait_for_room(JobSize size) {
  std::unique_lock lock(mutex_);
  wait_for_room(lock, size);
}

void OutputQueue::wait_for_room(std::unique_lock<std::mutex>& lock, JobSize size) {
  done_.wait(lock, [&] { return failure_ || has_room(size); });
  if (failure_) std::rethrow_exception(failure_);
}

void OutputQueue::add(JobSize size, Job job) {
  {
    std::unique_lock lock(mutex_);
    wait_for_room(lock, size);
    waiting_.push_back({size, std::move(job)});
    ++count(size);
  }
  added_.notify_one();
}

void OutputQueue::drain() {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return large_ == 0 && small_ == 0; });
}

void OutputQueue::check() {
  if (!failed_.load(std::memory_order_relaxed)) return;
  const std::lock_guard lock(mutex_);
  std::rethrow_exception(failure_);
}

void OutputQueue::work() {
  for (;;) {
    Entry entry;
    {
      std::unique_lock lock(mutex_);
      added_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      entry = std::move(waiting_.front());
      waiting_.pop_front();
    }
    const JobSize size = entry.size;
    run(entry);
    entry.job = nullptr;  // its memory is free before it counts as done
    {
      const std::lock_guard lock(mutex_);
      --count(size);
    }
    done_.notify_all();
  }
}

void OutputQueue::run(const Entry& entry) {
  if (failed_.load(std::memory_order_relaxed)) return;  // only this thread sets it
  try {
    entry.job();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    failed_.store(true, std::memory_order_relaxed);
  }
}

}  // namespace scree
