// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <source_location>

#include "solver/emulation/launch.hpp"
#include "solver/emulation/shared_memory.hpp"

namespace scree::emulation {

inline constexpr int warp_size = 32;

/// The threads of a block, one fiber each, kept for the next block.
class FiberTeam {
 public:
  explicit FiberTeam(int threads);
  ~FiberTeam();
  FiberTeam(const FiberTeam&) = delete;
  FiberTeam& operator=(const FiberTeam&) = delete;

  int size() const;
  /// One block. Throws what a thread throws, and std::logic_error where threads diverge; the team
  /// is then of no further use.
  void run(const std::function<void()>& body, int block, int blocks, bool backward);

  // For the fiber that runs:
  const ThreadPlace& place() const;
  void block_barrier(std::source_location at);
  std::uint64_t exchange(std::uint64_t bits, int lane, std::source_location at);
  SharedMemory& shared() { return shared_; }

 private:
  struct Fiber;
  struct Members;
  void resume(Fiber& fiber);
  void wait(int state, std::source_location at);
  void run_warp(int warp);
  void release_warp(int warp);
  void release_block();
  void unwind();

  std::unique_ptr<Members> members_;
  SharedMemory shared_;
};

}  // namespace scree::emulation
