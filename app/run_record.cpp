// SPDX-License-Identifier: Apache-2.0
#include "app/run_record.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/file_descriptor.hpp"

namespace scree {

namespace fs = std::filesystem;

double RunRecord::particle_updates_per_second() const {
  return wall_seconds > 0 ? particle_updates / wall_seconds : 0;
}

std::string to_json(const RunRecord& record) {
  nlohmann::ordered_json json;
  json["status"] = record.status;
  json["version"] = record.version;
  json["title"] = record.title;
  json["deck"] = record.deck;
  json["backend"] = record.backend;
  json["threads"] = record.threads;
  json["particles"] = record.particles;
  json["removed_particles"] = record.removed_particles;
  json["steps"] = record.steps;
  json["simulated_time"] = record.simulated_time;
  json["end_time"] = record.end_time;
  json["wall_seconds"] = record.wall_seconds;
  json["particle_updates"] = record.particle_updates;
  json["particle_updates_per_second"] = record.particle_updates_per_second();
  if (record.particles > 0) json["bytes_per_particle"] = record.bytes_per_particle;
  json["phases"] = record.phases;
  json["faults"] = record.faults;
  json["cite"] = record.cite;
  // Names and paths are bytes on this system; what is no UTF-8 is shown with a substitute.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_record(const fs::path& path, const RunRecord& record) {
  replace_file(path, to_json(record));
}

bool write_last_record(const fs::path& path, const RunRecord& record) {
  const std::string text = to_json(record);
  try {
    replace_file(path, text);
    return true;
  } catch (const RunFault&) {
    // The old file's blocks usually hold the new text too.
    FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    return file.is_open() && file.write_all(text.data(), text.size()) == 0 &&
           ::ftruncate(file.get(), static_cast<off_t>(text.size())) == 0;
  }
}

void add_former_times(RunRecord& record, const fs::path& path) {
  std::ifstream in(path);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) return;
  const auto number = [](const nlohmann::json& object, const std::string& key) {
    return object.contains(key) && object[key].is_number() ? object[key].get<double>() : 0.0;
  };
  record.wall_seconds += number(json, "wall_seconds");
  record.particle_updates += number(json, "particle_updates");
  if (!json.contains("phases") || !json["phases"].is_object()) return;
  for (const auto& phase : json["phases"].items()) {
    record.phases[phase.key()] += number(json["phases"], phase.key());
  }
}

}  // namespace scree
