// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace scree {

/// Particles of a batch on a device: the threads of a warp read consecutive memory.
inline constexpr int device_width = 32;

/// Memory and sorting of a device. Work is done in the order in which it is asked for; only
/// download() and wait() wait for it. Sizes are in bytes.
class Device {
 public:
  virtual ~Device() = default;

  virtual std::string name() const = 0;
  virtual std::size_t free_memory() const = 0;
  /// Throws RunFault where there is no room; what: for the message.
  virtual void* allocate(std::size_t bytes, const char* what) = 0;
  virtual void release(void* p) noexcept = 0;
  virtual void upload(void* to, const void* from, std::size_t bytes) = 0;
  virtual void download(void* to, const void* from, std::size_t bytes) = 0;
  virtual void copy(void* to, const void* from, std::size_t bytes) = 0;
  virtual void zero(void* to, std::size_t bytes) = 0;
  virtual void wait() = 0;

  /// Sorts keys and, with them, values; equal keys keep their order.
  virtual void sort(std::uint64_t* keys, std::int32_t* values, std::int64_t count) = 0;
  /// The different keys of a sorted list and how often each is there; returns their number.
  virtual std::int64_t find_runs(const std::uint64_t* keys, std::int64_t count,
                                 std::uint64_t* different, std::int32_t* length) = 0;
};

}  // namespace scree
