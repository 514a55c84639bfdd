// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace scree {

/// While it lives, calls a function before and after every change of a file by this process through
/// write, pwrite, ftruncate, posix_fallocate and rename: the moments between which a file is as
/// another program, or the next start, would find it. One at a time; not while other threads write.
class WriteWatch {
 public:
  explicit WriteWatch(std::function<void()> look);
  WriteWatch(const WriteWatch&) = delete;
  WriteWatch& operator=(const WriteWatch&) = delete;
  ~WriteWatch();
};

}  // namespace scree
