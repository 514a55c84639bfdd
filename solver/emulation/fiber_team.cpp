// SPDX-License-Identifier: Apache-2.0
#include "solver/emulation/fiber_team.hpp"

#include <algorithm>
#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#endif

namespace scree::emulation {
namespace {

namespace context = boost::context;

// Instrumented frames of a fused pass are large.
constexpr std::size_t stack_bytes = 256 * 1024;

enum State : int { idle, running, at_warp, at_block };

/// Ends a fiber that waits, so that what it owns is given back.
struct Unwind {};

/// Tells an address sanitizer which stack is in use.
struct StackSwitch {
  void* fake = nullptr;
  void leave([[maybe_unused]] const void* bottom, [[maybe_unused]] std::size_t size,
             [[maybe_unused]] bool last = false) {
#ifdef __SANITIZE_ADDRESS__
    __sanitizer_start_switch_fiber(last ? nullptr : &fake, bottom, size);
#endif
  }
  void arrive([[maybe_unused]] const void** bottom = nullptr,
              [[maybe_unused]] std::size_t* size = nullptr) {
#ifdef __SANITIZE_ADDRESS__
    __sanitizer_finish_switch_fiber(fake, bottom, size);
#endif
  }
};

std::string text(std::source_location at) {
  std::string file = at.file_name();
  const std::size_t slash = file.rfind('/');
  if (slash != std::string::npos) file.erase(0, slash + 1);
  return file + ":" + std::to_string(at.line());
}

}  // namespace

struct FiberTeam::Fiber {
  context::fiber fiber;
  context::stack_context stack;
  StackSwitch stacks;
  ThreadPlace place;
  int state = idle;
  std::uint64_t slot = 0;
  std::source_location at;
};

struct FiberTeam::Members {
  std::vector<Fiber> fibers;
  context::protected_fixedsize_stack allocator{stack_bytes};
  context::fiber scheduler;
  StackSwitch stacks;
  const void* bottom = nullptr;  ///< of the scheduler's stack
  std::size_t size = 0;
  Fiber* current = nullptr;
  const std::function<void()>* body = nullptr;
  bool backward = false;
  bool stop = false;
  std::exception_ptr failure;
};

FiberTeam::FiberTeam(int threads) : members_(std::make_unique<Members>()) {
  Members& m = *members_;
  m.fibers.resize(std::size_t(threads));
  for (Fiber& fiber : m.fibers) {
    fiber.stack = m.allocator.allocate();
    const context::preallocated place(fiber.stack.sp, fiber.stack.size, fiber.stack);
    fiber.fiber = context::fiber(std::allocator_arg, place, m.allocator,
                                 [this, &m, &fiber](context::fiber&& from) {
                                   m.scheduler = std::move(from);
                                   fiber.stacks.arrive(&m.bottom, &m.size);
                                   while (!m.stop) {
                                     try {
                                       (*m.body)();
                                     } catch (const Unwind&) {
                                     } catch (...) {
                                       if (!m.failure) m.failure = std::current_exception();
                                     }
                                     if (m.stop) break;
                                     wait(idle, std::source_location::current());
                                   }
                                   fiber.state = idle;
                                   fiber.stacks.leave(m.bottom, m.size, true);
                                   return std::move(m.scheduler);
                                 });
  }
}

FiberTeam::~FiberTeam() { unwind(); }

int FiberTeam::size() const { return int(members_->fibers.size()); }

const ThreadPlace& FiberTeam::place() const { return members_->current->place; }

/// Hands the processor to a fiber until it waits or ends.
void FiberTeam::resume(Fiber& fiber) {
  Members& m = *members_;
  fiber.state = running;
  m.current = &fiber;
  m.stacks.leave(static_cast<const char*>(fiber.stack.sp) - fiber.stack.size, fiber.stack.size);
  fiber.fiber = std::move(fiber.fiber).resume();
  m.stacks.arrive();
  m.current = nullptr;
}

/// Hands the processor back to the scheduler.
void FiberTeam::wait(int state, std::source_location at) {
  Members& m = *members_;
  Fiber& fiber = *m.current;
  fiber.state = state;
  fiber.at = at;
  fiber.stacks.leave(m.bottom, m.size);
  m.scheduler = std::move(m.scheduler).resume();
  fiber.stacks.arrive(&m.bottom, &m.size);
  if (m.stop && state != idle) throw Unwind{};
}

void FiberTeam::block_barrier(std::source_location at) { wait(at_block, at); }

std::uint64_t FiberTeam::exchange(std::uint64_t bits, int lane, std::source_location at) {
  Members& m = *members_;
  Fiber& fiber = *m.current;
  fiber.slot = bits;
  wait(at_warp, at);
  const int warp = fiber.place.thread / warp_size;
  const std::uint64_t other = m.fibers[std::size_t(warp * warp_size + lane)].slot;
  wait(at_warp, at);  // nobody may overwrite its slot before all have read
  return other;
}

/// Lets the threads of a warp run until all wait at the block's barrier or have ended.
void FiberTeam::run_warp(int warp) {
  Members& m = *members_;
  for (;;) {
    bool warp_waits = false;
    for (int i = 0; i < warp_size; ++i) {
      const int lane = m.backward ? warp_size - 1 - i : i;
      Fiber& fiber = m.fibers[std::size_t(warp * warp_size + lane)];
      if (fiber.state == running) resume(fiber);
      if (m.failure) std::rethrow_exception(std::exchange(m.failure, nullptr));
      warp_waits = warp_waits || fiber.state == at_warp;
    }
    if (!warp_waits) return;
    release_warp(warp);
  }
}

void FiberTeam::release_warp(int warp) {
  Members& m = *members_;
  const auto first = m.fibers.begin() + warp * warp_size;
  for (auto fiber = first; fiber != first + warp_size; ++fiber) {
    if (fiber->state == at_warp) continue;
    const auto waiting =
        std::find_if(first, first + warp_size, [](const Fiber& f) { return f.state == at_warp; });
    throw std::logic_error(
        "thread " + std::to_string(waiting->place.thread) + " of block " +
        std::to_string(waiting->place.block) + " waits for its warp at " + text(waiting->at) +
        ", but thread " + std::to_string(fiber->place.thread) +
        (fiber->state == idle ? " has ended" : " waits for the block at " + text(fiber->at)));
  }
  for (auto fiber = first; fiber != first + warp_size; ++fiber) fiber->state = running;
}

/// All threads must wait at the same barrier.
void FiberTeam::release_block() {
  Members& m = *members_;
  const auto waits = [](const Fiber& f) { return f.state == at_block; };
  const auto waiting = std::find_if(m.fibers.begin(), m.fibers.end(), waits);
  for (Fiber& fiber : m.fibers) {
    if (fiber.state == at_block && fiber.at.line() == waiting->at.line()) continue;
    throw std::logic_error("divergent barrier: thread " + std::to_string(waiting->place.thread) +
                           " of block " + std::to_string(waiting->place.block) + " waits at " +
                           text(waiting->at) + ", but thread " +
                           std::to_string(fiber.place.thread) +
                           (fiber.state == idle ? " has ended" : " waits at " + text(fiber.at)));
  }
  for (Fiber& fiber : m.fibers) fiber.state = running;
}

void FiberTeam::run(const std::function<void()>& body, int block, int blocks, bool backward) {
  Members& m = *members_;
  m.body = &body;
  m.backward = backward;
  shared_.begin_block();
  for (int i = 0; i < size(); ++i) {
    m.fibers[std::size_t(i)].place = {i, size(), block, blocks};
    m.fibers[std::size_t(i)].state = running;
  }
  const int warps = size() / warp_size;
  for (;;) {
    for (int w = 0; w < warps; ++w) run_warp(backward ? warps - 1 - w : w);
    const auto waits = [](const Fiber& f) { return f.state == at_block; };
    if (std::none_of(m.fibers.begin(), m.fibers.end(), waits)) break;
    release_block();
  }
  shared_.end_block();
}

/// Ends all fibers.
void FiberTeam::unwind() {
  Members& m = *members_;
  m.stop = true;
  const std::function<void()> nothing = [] {};
  m.body = &nothing;
  for (Fiber& fiber : m.fibers) {
    if (fiber.fiber) resume(fiber);
  }
}

}  // namespace scree::emulation
