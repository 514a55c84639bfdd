// SPDX-License-Identifier: Apache-2.0
#include "verification/unit/write_watch.hpp"

#include <dlfcn.h>
#include <sys/types.h>

#include <utility>

namespace scree {
namespace {

std::function<void()>& look() {
  static std::function<void()> function;
  return function;
}

bool looking = false;

/// What the function finds may itself write.
void call() {
  if (looking || !look()) return;
  looking = true;
  look()();
  looking = false;
}

template <class F, class... A>
auto watched(const char* name, A... arguments) {
  const auto real = reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
  call();
  const auto result = real(arguments...);
  call();
  return result;
}

}  // namespace

WriteWatch::WriteWatch(std::function<void()> function) { look() = std::move(function); }
WriteWatch::~WriteWatch() { look() = nullptr; }

}  // namespace scree

// In place of the C library's functions of these names, also for the libraries of the program.
extern "C" {

ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t offset) {
  return scree::watched<decltype(&pwrite)>("pwrite", file, bytes, count, offset);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t count, off64_t offset) {
  return scree::watched<decltype(&pwrite64)>("pwrite64", file, bytes, count, offset);
}
ssize_t write(int file, const void* bytes, std::size_t count) {
  return scree::watched<decltype(&write)>("write", file, bytes, count);
}
int ftruncate(int file, off_t length) noexcept {
  return scree::watched<decltype(&ftruncate)>("ftruncate", file, length);
}
int ftruncate64(int file, off64_t length) noexcept {
  return scree::watched<decltype(&ftruncate64)>("ftruncate64", file, length);
}
int posix_fallocate(int file, off_t offset, off_t length) {
  return scree::watched<decltype(&posix_fallocate)>("posix_fallocate", file, offset, length);
}
int posix_fallocate64(int file, off64_t offset, off64_t length) {
  return scree::watched<decltype(&posix_fallocate64)>("posix_fallocate64", file, offset, length);
}
int rename(const char* from, const char* to) noexcept {
  return scree::watched<decltype(&rename)>("rename", from, to);
}
}
