// SPDX-License-Identifier: Apache-2.0
#include "solver/emulation/launch.hpp"

#include <barrier>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "solver/emulation/fiber_team.hpp"

namespace scree::emulation {
namespace {

/// The threads of a block as threads of the machine.
struct ThreadTeam {
  explicit ThreadTeam(int threads) : barrier(threads), slots(std::size_t(threads)) {}
  std::barrier<> barrier;
  std::vector<std::uint64_t> slots;
  SharedMemory shared;
};

struct Launcher {
  Order order = Order::forward;
  std::int64_t launches = 0;
  std::int64_t downloaded = 0;
  std::size_t free_memory = std::size_t(1) << 34;
  std::unique_ptr<FiberTeam> team;
};

thread_local Launcher launcher;
thread_local FiberTeam* fibers = nullptr;    // of the kernel that runs here
thread_local ThreadTeam* machine = nullptr;  // the same, with real threads
thread_local ThreadPlace machine_place;

void run_threads(const std::function<void()>& body, int block, int blocks, int threads) {
  ThreadTeam team(threads);
  std::vector<std::thread> workers;
  for (int i = 0; i < threads; ++i) {
    workers.emplace_back([&, i] {
      machine = &team;
      machine_place = {i, threads, block, blocks};
      body();
    });
  }
  for (std::thread& worker : workers) worker.join();
  team.shared.end_block();
}

void run_fibers(const std::function<void()>& body, int block, int blocks, int threads) {
  if (!launcher.team || launcher.team->size() != threads) {
    launcher.team.reset();
    launcher.team = std::make_unique<FiberTeam>(threads);
  }
  fibers = launcher.team.get();
  try {
    fibers->run(body, block, blocks, launcher.order == Order::backward);
  } catch (...) {
    fibers = nullptr;
    launcher.team.reset();
    throw;
  }
  fibers = nullptr;
}

}  // namespace

void set_order(Order order) { launcher.order = order; }

void set_free_memory(std::size_t bytes) { launcher.free_memory = bytes; }

std::size_t free_memory() { return launcher.free_memory; }

std::int64_t downloaded() { return launcher.downloaded; }
void note_download(std::size_t bytes) { launcher.downloaded += std::int64_t(bytes); }
std::int64_t launches() { return launcher.launches; }

void launch(int blocks, int threads, const std::function<void()>& body) {
  if (threads < warp_size || threads % warp_size != 0 || threads > 1024) {
    throw std::logic_error("a block of " + std::to_string(threads) +
                           " threads: a multiple of 32 up to 1024 is needed");
  }
  if (blocks < 1) throw std::logic_error("a launch needs a block");
  ++launcher.launches;
  for (int i = 0; i < blocks; ++i) {
    const int block = launcher.order == Order::backward ? blocks - 1 - i : i;
    if (launcher.order == Order::threads) {
      run_threads(body, block, blocks, threads);
    } else {
      run_fibers(body, block, blocks, threads);
    }
  }
}

const ThreadPlace& place() { return fibers != nullptr ? fibers->place() : machine_place; }

void block_barrier(std::source_location at) {
  if (fibers != nullptr) return fibers->block_barrier(at);
  machine->barrier.arrive_and_wait();
}

std::uint64_t exchange(std::uint64_t bits, int lane, std::source_location at) {
  if (fibers != nullptr) return fibers->exchange(bits, lane, at);
  machine->slots[std::size_t(machine_place.thread)] = bits;
  machine->barrier.arrive_and_wait();  // of the block: all warps exchange at the same places
  const int first = machine_place.thread / warp_size * warp_size;
  const std::uint64_t other = machine->slots[std::size_t(first + lane)];
  machine->barrier.arrive_and_wait();
  return other;
}

void* shared_memory(const void* name, std::size_t bytes) {
  return (fibers != nullptr ? fibers->shared() : machine->shared).piece(name, bytes);
}

}  // namespace scree::emulation
