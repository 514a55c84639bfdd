// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <source_location>

/// CUDA kernels on the processor, for tests: a thread block is a team of fibers that take turns.
///
/// A fiber runs until it waits at a barrier or ends, so a launch gives the same bits every time.
/// The team finds what a GPU answers with silence or a hang: a barrier that not all threads of a
/// block reach, or that they reach at different places; shared memory that is read before it was
/// written (it starts as NaN) or written beyond its end.
namespace scree::emulation {

/// The order in which the threads of a block, and the blocks, take their turns. A kernel whose
/// result hangs on it beyond rounding lacks a barrier. `threads`: real threads at once, for a
/// thread sanitizer; divergence is then not noticed.
enum class Order { forward, backward, threads };

/// Order of this thread's launches from now on.
void set_order(Order order);

/// Runs body() for all threads of all blocks. threads: a multiple of 32, at most 1024. Throws
/// std::logic_error for a defect of the kernel, in one sentence that names it.
void launch(int blocks, int threads, const std::function<void()>& body);

/// Memory that emulated devices say is free [bytes], from now on; 16 GiB at first.
void set_free_memory(std::size_t bytes);
std::size_t free_memory();

/// Launches of this thread so far.
std::int64_t launches();

/// Bytes that emulated devices have given to this thread so far; note_download() counts them.
std::int64_t downloaded();
void note_download(std::size_t bytes);

/// Numbers of the CUDA thread that runs.
struct ThreadPlace {
  int thread = 0;
  int threads = 0;
  int block = 0;
  int blocks = 0;
};
const ThreadPlace& place();

/// __syncthreads.
void block_barrier(std::source_location at);
/// The bits of the thread `lane` of this warp; all of the warp must take part.
std::uint64_t exchange(std::uint64_t bits, int lane, std::source_location at);

/// Shared memory of the running block under a name; all threads get the same.
void* shared_memory(const void* name, std::size_t bytes);

/// Shared memory of type S; the tag's type is the name.
template <class S, class Tag>
S& shared(Tag) {
  static_assert(alignof(S) <= 64);
  static char name = 0;
  return *static_cast<S*>(shared_memory(&name, sizeof(S)));
}

}  // namespace scree::emulation
