// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <vector>

#include "solver/base/error.hpp"
#include "solver/device/open_device.cuh"
#include "solver/emulation/launch.hpp"

namespace scree {
inline namespace emulated {
namespace {

/// Memory of this machine. It starts as NaN, so that what was never written shows.
class EmulatedDevice final : public Device {
 public:
  std::string name() const override { return "emulated"; }
  std::size_t free_memory() const override { return emulation::free_memory(); }

  void* allocate(std::size_t bytes, const char* what) override {
    void* p = std::malloc(bytes);
    if (p == nullptr) throw RunFault(std::string("no memory for ") + what);
    std::memset(p, 0xFF, bytes);
    return p;
  }
  void release(void* p) noexcept override { std::free(p); }
  void upload(void* to, const void* from, std::size_t bytes) override {
    std::memcpy(to, from, bytes);
  }
  void download(void* to, const void* from, std::size_t bytes) override {
    emulation::note_download(bytes);
    std::memcpy(to, from, bytes);
  }
  void copy(void* to, const void* from, std::size_t bytes) override {
    std::memcpy(to, from, bytes);
  }
  void zero(void* to, std::size_t bytes) override { std::memset(to, 0, bytes); }
  void wait() override {}

  void sort(std::uint64_t* keys, std::int32_t* values, std::int64_t count) override {
    std::vector<std::int64_t> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), std::int64_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [keys](std::int64_t a, std::int64_t b) { return keys[a] < keys[b]; });
    const std::vector<std::uint64_t> old_keys(keys, keys + count);
    const std::vector<std::int32_t> old_values(values, values + count);
    for (std::size_t i = 0; i < order.size(); ++i) {
      keys[i] = old_keys[std::size_t(order[i])];
      values[i] = old_values[std::size_t(order[i])];
    }
  }

  std::int64_t find_runs(const std::uint64_t* keys, std::int64_t count, std::uint64_t* different,
                         std::int32_t* length) override {
    std::int64_t runs = 0;
    for (std::int64_t i = 0; i < count; ++i) {
      if (i == 0 || keys[i] != keys[i - 1]) {
        different[runs] = keys[i];
        length[runs++] = 0;
      }
      ++length[runs - 1];
    }
    return runs;
  }
};

}  // namespace

std::unique_ptr<Device> open_device() { return std::make_unique<EmulatedDevice>(); }

}  // namespace emulated
}  // namespace scree
