// SPDX-License-Identifier: Apache-2.0
#include "solver/io/history_writer.hpp"

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

std::string header_line(const std::vector<std::string>& collider_names, bool fluid) {
  return fmt::format("{}\n", fmt::join(history_columns(collider_names, fluid), ","));
}

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

void append_numbers(std::string& line, const double* values, int count) {
  for (int i = 0; i < count; ++i) fmt::format_to(std::back_inserter(line), ",{}", values[i]);
}

}  // namespace

std::vector<std::string> history_columns(const std::vector<std::string>& collider_names,
                                         bool fluid) {
  std::vector<std::string> names = {"step", "time", "dt", "particle_count", "mass"};
  for (const char* vector : {"momentum", "angular_momentum", "center"}) {
    for (const char* axis : {"x", "y", "z"}) names.push_back(fmt::format("{}_{}", vector, axis));
  }
  names.insert(names.end(), {"kinetic_energy", "elastic_energy", "max_speed"});
  if (fluid) {
    names.insert(names.end(),
                 {"fluid_mass", "fluid_outflow", "fluid_balance_error", "pressure_iterations"});
  }
  for (const std::string& collider : collider_names) {
    for (const char* vector : {"force", "torque"}) {
      for (const char* axis : {"x", "y", "z"}) {
        names.push_back(fmt::format("{}_{}_{}", collider, vector, axis));
      }
    }
  }
  return names;
}

HistoryWriter::HistoryWriter(fs::path path, FileDescriptor file, std::size_t collider_count,
                             bool fluid)
    : path_(std::move(path)),
      file_(std::move(file)),
      collider_count_(collider_count),
      fluid_(fluid) {}

HistoryWriter HistoryWriter::create(const fs::path& path,
                                    const std::vector<std::string>& collider_names, bool fluid) {
  HistoryWriter writer(path, open_for_append(path, O_CREAT | O_TRUNC), collider_names.size(),
                       fluid);
  writer.append(header_line(collider_names, fluid));
  return writer;
}

HistoryWriter HistoryWriter::resume(const fs::path& path,
                                    const std::vector<std::string>& collider_names,
                                    std::int64_t last_step, bool fluid) {
  const std::string text = read_all(path);
  const std::string header = header_line(collider_names, fluid);
  if (!text.starts_with(header)) {
    throw RunFault(fmt::format("{} has other columns than this run writes; it cannot be continued",
                               path.string()));
  }
  FileDescriptor file = open_for_append(path, 0);
  const std::size_t kept = kept_length(text, header.size(), last_step);
  if (::ftruncate(file.get(), static_cast<off_t>(kept)) != 0) {
    throw RunFault(write_failure(path, errno));
  }
  return HistoryWriter(path, std::move(file), collider_names.size(), fluid);
}

void HistoryWriter::add(const HistoryRow& row) {
  if (row.collider_force_torque.size() != collider_count_) {
    throw std::logic_error("history row with another number of colliders than the header");
  }
  if (row.fluid.has_value() != fluid_) {
    throw std::logic_error("history row with pore water where the header has none, or without");
  }
  std::string line =
      fmt::format("{},{},{},{},{}", row.step, row.time, row.dt, row.particle_count, row.mass);
  append_numbers(line, row.momentum, 3);
  append_numbers(line, row.angular_momentum, 3);
  append_numbers(line, row.center, 3);
  append_numbers(line, &row.kinetic_energy, 1);
  append_numbers(line, &row.elastic_energy, 1);
  append_numbers(line, &row.max_speed, 1);
  if (row.fluid) {
    const double numbers[3] = {row.fluid->mass, row.fluid->outflow, row.fluid->error};
    append_numbers(line, numbers, 3);
    fmt::format_to(std::back_inserter(line), ",{}", row.fluid->iterations);
  }
  for (const auto& reaction : row.collider_force_torque) append_numbers(line, reaction.data(), 6);
  line += '\n';
  append(line);
}

void HistoryWriter::append(const std::string& line) {
  struct stat before {};
  if (::fstat(file_.get(), &before) != 0) throw RunFault(write_failure(path_, errno));
  const int error = file_.write_all(line.data(), line.size());
  if (error == 0) return;
  // A row that went in half is taken out again, so that the file ends with a complete one.
  const bool cut = ::ftruncate(file_.get(), before.st_size) == 0;
  throw RunFault(write_failure(path_, error) + (cut ? "" : " (its last row is incomplete)"));
}

void HistoryWriter::sync() {
  // Special files (a pipe, /dev/full) cannot be synced; they have nothing to lose either.
  if (::fsync(file_.get()) != 0 && errno != EINVAL && errno != EROFS) {
    throw RunFault(write_failure(path_, errno));
  }
}

}  // namespace scree
