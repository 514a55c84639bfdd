// SPDX-License-Identifier: Apache-2.0
#include "app/memory_info.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace scree {
namespace {

/// The number after `key` in a file of lines "key: number kB", in bytes.
std::optional<std::int64_t> kilobytes_line(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    std::int64_t number = 0;
    if (word == key && file >> number) return number * 1024;
  }
  return {};
}

std::optional<std::int64_t> number_in(const char* path) {
  std::ifstream file(path);
  std::int64_t number = 0;
  if (file >> number) return number;
  return {};  // no such file, or "max"
}

}  // namespace

std::int64_t resident_memory() { return kilobytes_line("/proc/self/status", "VmRSS:").value_or(0); }

std::int64_t peak_memory() {
  if (const auto peak = kilobytes_line("/proc/self/status", "VmHWM:")) return *peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t(usage.ru_maxrss) * 1024;
}

bool reset_peak_memory() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return bool(file);
}

std::optional<std::int64_t> free_memory() {
  auto bytes = kilobytes_line("/proc/meminfo", "MemAvailable:");
  // A container may be allowed less than the machine has.
  const auto limit = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (limit && used) {
    bytes = std::min(bytes.value_or(*limit), std::max<std::int64_t>(0, *limit - *used));
  }
  return bytes;
}

}  // namespace scree
