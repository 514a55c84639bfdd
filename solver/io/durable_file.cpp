// SPDX-License-Identifier: Apache-2.0
#include "solver/io/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "solver/base/error.hpp"
#include "solver/io/file_descriptor.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

void sync(const fs::path& path, int flags) {
  FileDescriptor file(::open(path.c_str(), flags | O_CLOEXEC));
  if (!file.is_open() || ::fsync(file.get()) != 0) throw RunFault(write_failure(path, errno));
}

}  // namespace

fs::path aside(const fs::path& path) { return path.string() + ".tmp"; }

void take_name(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) != 0) throw RunFault(write_failure(path, errno));
}

void take_name_durably(const fs::path& temporary, const fs::path& path) {
  sync(temporary, O_RDONLY);
  take_name(temporary, path);
  const fs::path folder = path.parent_path();
  sync(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
}

void replace_file(const fs::path& path, const std::string& text) {
  const fs::path temporary = aside(path);
  {
    FileDescriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    const int error = file.is_open() ? file.write_all(text.data(), text.size()) : errno;
    if (error != 0) {
      ::unlink(temporary.c_str());
      throw RunFault(write_failure(path, error));
    }
  }
  take_name(temporary, path);
}

std::string write_failure(const fs::path& path, int error) {
  return "cannot write " + path.string() +
         (error != 0 ? ": " + std::string(std::strerror(error)) : "");
}

}  // namespace scree
