// SPDX-License-Identifier: Apache-2.0
#include "solver/io/history_writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

namespace scree {

namespace fs = std::filesystem;

namespace {

std::string header_line(const HistoryParts& parts) {
  return fmt::format("{}", fmt::join(history_columns(parts), ","));
}

void append_numbers(std::string& line, const double* values, int count) {
  for (int i = 0; i < count; ++i) fmt::format_to(std::back_inserter(line), ",{}", values[i]);
}

}  // namespace

std::vector<std::string> history_columns(const HistoryParts& parts) {
  std::vector<std::string> names = {"step", "time", "dt", "particle_count", "mass"};
  for (const char* vector : {"momentum", "angular_momentum", "center"}) {
    for (const char* axis : {"x", "y", "z"}) names.push_back(fmt::format("{}_{}", vector, axis));
  }
  names.insert(names.end(), {"kinetic_energy", "elastic_energy", "max_speed"});
  if (parts.drains) {
    names.insert(names.end(), {"fluid_mass", "fluid_outflow", "fluid_balance_error",
                               "pressure_iterations", "step_halvings"});
    for (const std::string& drain : *parts.drains) names.push_back("fluid_outflow_" + drain);
  }
  if (parts.loads) names.emplace_back("external_work");
  for (const std::string& collider : parts.colliders) {
    for (const char* vector : {"force", "torque"}) {
      for (const char* axis : {"x", "y", "z"}) {
        names.push_back(fmt::format("{}_{}_{}", collider, vector, axis));
      }
    }
    names.push_back(collider + "_work");
  }
  return names;
}

HistoryWriter::HistoryWriter(CsvWriter file, const HistoryParts& parts)
    : file_(std::move(file)), collider_count_(parts.colliders.size()), loads_(parts.loads) {
  if (parts.drains) drain_count_ = parts.drains->size();
}

HistoryWriter HistoryWriter::create(const fs::path& path, const HistoryParts& parts) {
  return HistoryWriter(CsvWriter::create(path, header_line(parts)), parts);
}

HistoryWriter HistoryWriter::resume(const fs::path& path, const HistoryParts& parts,
                                    std::int64_t last_step) {
  return HistoryWriter(CsvWriter::resume(path, header_line(parts), last_step), parts);
}

void HistoryWriter::add(const HistoryRow& row) {
  if (row.collider_force_torque.size() != collider_count_ ||
      row.collider_work.size() != collider_count_) {
    throw std::logic_error("history row with another number of colliders than the header");
  }
  if (row.fluid.has_value() != drain_count_.has_value()) {
    throw std::logic_error("history row with pore water where the header has none, or without");
  }
  if (row.fluid && row.fluid->surfaces.size() != *drain_count_) {
    throw std::logic_error("history row with another number of drained surfaces than the header");
  }
  if (row.external_work.has_value() != loads_) {
    throw std::logic_error("history row with the work of loads where the header has none, or not");
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
    fmt::format_to(std::back_inserter(line), ",{},{}", row.fluid->iterations, row.fluid->halvings);
    append_numbers(line, row.fluid->surfaces.data(), int(row.fluid->surfaces.size()));
  }
  if (row.external_work) append_numbers(line, &*row.external_work, 1);
  for (std::size_t c = 0; c < collider_count_; ++c) {
    append_numbers(line, row.collider_force_torque[c].data(), 6);
    append_numbers(line, &row.collider_work[c], 1);
  }
  file_.add(line + "\n");
}

void HistoryWriter::sync() { file_.sync(); }

}  // namespace scree
