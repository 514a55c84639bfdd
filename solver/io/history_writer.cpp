// SPDX-License-Identifier: Apache-2.0
#include "solver/io/history_writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

namespace scree {

namespace fs = std::filesystem;

namespace {

std::string header_line(const std::vector<std::string>& collider_names, const DrainNames& drains) {
  return fmt::format("{}", fmt::join(history_columns(collider_names, drains), ","));
}

void append_numbers(std::string& line, const double* values, int count) {
  for (int i = 0; i < count; ++i) fmt::format_to(std::back_inserter(line), ",{}", values[i]);
}

}  // namespace

std::vector<std::string> history_columns(const std::vector<std::string>& collider_names,
                                         const DrainNames& drains) {
  std::vector<std::string> names = {"step", "time", "dt", "particle_count", "mass"};
  for (const char* vector : {"momentum", "angular_momentum", "center"}) {
    for (const char* axis : {"x", "y", "z"}) names.push_back(fmt::format("{}_{}", vector, axis));
  }
  names.insert(names.end(), {"kinetic_energy", "elastic_energy", "max_speed"});
  if (drains) {
    names.insert(names.end(),
                 {"fluid_mass", "fluid_outflow", "fluid_balance_error", "pressure_iterations"});
    for (const std::string& drain : *drains) names.push_back("fluid_outflow_" + drain);
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

HistoryWriter::HistoryWriter(CsvWriter file, std::size_t collider_count, const DrainNames& drains)
    : file_(std::move(file)), collider_count_(collider_count) {
  if (drains) drain_count_ = drains->size();
}

HistoryWriter HistoryWriter::create(const fs::path& path,
                                    const std::vector<std::string>& collider_names,
                                    const DrainNames& drains) {
  return HistoryWriter(CsvWriter::create(path, header_line(collider_names, drains)),
                       collider_names.size(), drains);
}

HistoryWriter HistoryWriter::resume(const fs::path& path,
                                    const std::vector<std::string>& collider_names,
                                    std::int64_t last_step, const DrainNames& drains) {
  return HistoryWriter(CsvWriter::resume(path, header_line(collider_names, drains), last_step),
                       collider_names.size(), drains);
}

void HistoryWriter::add(const HistoryRow& row) {
  if (row.collider_force_torque.size() != collider_count_) {
    throw std::logic_error("history row with another number of colliders than the header");
  }
  if (row.fluid.has_value() != drain_count_.has_value()) {
    throw std::logic_error("history row with pore water where the header has none, or without");
  }
  if (row.fluid && row.fluid->surfaces.size() != *drain_count_) {
    throw std::logic_error("history row with another number of drained surfaces than the header");
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
    append_numbers(line, row.fluid->surfaces.data(), int(row.fluid->surfaces.size()));
  }
  for (const auto& reaction : row.collider_force_torque) append_numbers(line, reaction.data(), 6);
  file_.add(line + "\n");
}

void HistoryWriter::sync() { file_.sync(); }

}  // namespace scree
