// SPDX-License-Identifier: Apache-2.0
#include "app/machine_info.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "generated/build_info.hpp"

namespace scree {
namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

/// Bytes of the last level of cache.
std::int64_t cache_size() {
#ifdef _SC_LEVEL3_CACHE_SIZE
  for (const int name : {_SC_LEVEL3_CACHE_SIZE, _SC_LEVEL2_CACHE_SIZE}) {
    if (const long bytes = sysconf(name); bytes > 0) return bytes;
  }
#endif
  return 0;
}

}  // namespace

const char* instruction_set() {
#if defined(__AVX512F__)
  return "AVX-512";
#elif defined(__AVX2__)
  return "AVX2";
#elif defined(__AVX__)
  return "AVX";
#elif defined(__SSE4_2__)
  return "SSE4.2";
#elif defined(__ARM_NEON)
  return "NEON";
#else
  return "baseline";
#endif
}

int thread_count(int asked) {
  return asked > 0 ? asked : std::max(1, int(std::thread::hardware_concurrency()));
}

MachineInfo machine_info() {
  MachineInfo info;
  info.cpu = cpu_name();
  info.threads = thread_count(0);
  info.instruction_set = instruction_set();
  info.compiler = build_info::compiler;
  info.cache_bytes = cache_size();
  return info;
}

}  // namespace scree
