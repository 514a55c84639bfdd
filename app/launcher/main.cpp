// SPDX-License-Identifier: Apache-2.0
/// \file
/// The `scree` of a build for many machines: becomes the program that was compiled for the widest
/// instructions of this one. It shares no code with them, so it runs on any x86-64 machine.
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

bool runs_v4() {
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
         __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
}
bool runs_v3() {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
         __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
}
bool runs_v2() {
  return __builtin_cpu_supports("sse4.2") != 0 && __builtin_cpu_supports("popcnt") != 0;
}

struct Target {
  const char* name;
  bool (*runs_here)();
};

/// The widest first.
constexpr Target targets[] = {
    {"x86-64-v4", runs_v4}, {"x86-64-v3", runs_v3}, {"x86-64-v2", runs_v2}};

/// bin/scree -> libexec/scree/scree-<target>, wherever the tree was put; "" if /proc is missing.
std::string program_of(const char* target) {
  char self[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
  if (length <= 0) return "";
  std::string path(self, std::size_t(length));
  for (int level = 0; level < 2; ++level) path.erase(path.find_last_of('/'));
  return path + "/libexec/scree/scree-" + target;
}

/// Replaces this process; comes back only when that fails.
void become(const char* target, char** argv) {
  const std::string program = program_of(target);
  execv(program.c_str(), argv);
  if (errno != ENOENT) {
    std::fprintf(stderr, "scree: cannot start %s: %s\n", program.c_str(), std::strerror(errno));
    std::exit(1);
  }
}

/// SCREE_TARGET=name: that one and no other.
int become_wanted(const char* wanted, char** argv) {
  for (const Target& target : targets) {
    if (std::strcmp(target.name, wanted) != 0) continue;
    if (!target.runs_here()) {
      std::fprintf(stderr, "scree: SCREE_TARGET=%s: this machine lacks its instructions\n", wanted);
      return 2;
    }
    become(wanted, argv);
    std::fprintf(stderr, "scree: SCREE_TARGET=%s: %s is not installed\n", wanted,
                 program_of(wanted).c_str());
    return 2;
  }
  std::fprintf(stderr,
               "scree: SCREE_TARGET=%s: unknown; allowed: x86-64-v4, x86-64-v3, x86-64-v2\n",
               wanted);
  return 2;
}

}  // namespace

int main(int, char** argv) {
  __builtin_cpu_init();
  if (const char* wanted = std::getenv("SCREE_TARGET")) return become_wanted(wanted, argv);
  for (const Target& target : targets) {
    if (target.runs_here()) become(target.name, argv);  // one that was not built is passed over
  }
  std::fprintf(stderr, "scree: no program for this machine beside %s\n",
               program_of(targets[2].name).c_str());
  return 1;
}
