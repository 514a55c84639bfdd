// SPDX-License-Identifier: Apache-2.0
#include "solver/io/csv_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

FileDescriptor open_for_append(const fs::path& path, int flags) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | flags, 0666));
  if (!file.is_open()) throw RunFault(write_failure(path, errno));
  return file;
}

std::string read_all(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw RunFault(fmt::format("cannot read {}", path.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Length of the header and the complete rows of steps up to last_step.
std::size_t kept_length(const std::string& text, std::size_t header_length,
                        std::int64_t last_step) {
  std::size_t kept = header_length;
  while (kept < text.size()) {
    const std::size_t end = text.find('\n', kept);
    if (end == std::string::npos) break;
    std::int64_t step = 0;
    const auto result = std::from_chars(text.data() + kept, text.data() + end, step);
    if (result.ec != std::errc() || step > last_step) break;
    kept = end + 1;
  }
  return kept;
}

}  // namespace

CsvWriter::CsvWriter(fs::path path, FileDescriptor file)
    : path_(std::move(path)), file_(std::move(file)) {}

CsvWriter CsvWriter::create(const fs::path& path, const std::string& header) {
  CsvWriter writer(path, open_for_append(path, O_CREAT | O_TRUNC));
  writer.add(header + "\n");
  return writer;
}

CsvWriter CsvWriter::resume(const fs::path& path, const std::string& header,
                            std::int64_t last_step) {
  const std::string text = read_all(path);
  const std::size_t line = text.find('\n');
  const std::string found = text.substr(0, line);
  if (line == std::string::npos || (!header.empty() && found != header)) {
    throw RunFault(fmt::format("{} has other columns than this run writes; it cannot be continued",
                               path.string()));
  }
  FileDescriptor file = open_for_append(path, 0);
  const std::size_t kept = kept_length(text, line + 1, last_step);
  if (::ftruncate(file.get(), static_cast<off_t>(kept)) != 0) {
    throw RunFault(write_failure(path, errno));
  }
  return CsvWriter(path, std::move(file));
}

void CsvWriter::add(const std::string& lines) {
  struct stat before {};
  if (::fstat(file_.get(), &before) != 0) throw RunFault(write_failure(path_, errno));
  const int error = file_.write_all(lines.data(), lines.size());
  if (error == 0) return;
  // What went in half is taken out again, so that the file ends with a complete one.
  const bool cut = ::ftruncate(file_.get(), before.st_size) == 0;
  throw RunFault(write_failure(path_, error) + (cut ? "" : " (its last row is incomplete)"));
}

void CsvWriter::sync() {
  // Special files (a pipe, /dev/full) cannot be synced; they have nothing to lose either.
  if (::fsync(file_.get()) != 0 && errno != EINVAL && errno != EROFS) {
    throw RunFault(write_failure(path_, errno));
  }
}

}  // namespace scree
