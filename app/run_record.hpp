// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scree {

/// What run.json says about a run. Wall times, updates and phases are sums over the run and all
/// its continuations.
struct RunRecord {
  std::string status = "running";  ///< running, done, failed, interrupted
  std::string version, title, deck;
  std::string backend;
  int threads = 1;
  std::int64_t particles = 0;          ///< now in the domain
  std::int64_t removed_particles = 0;  ///< left through open faces
  std::int64_t steps = 0;
  double simulated_time = 0;  ///< s
  double end_time = 0;        ///< s, of the deck
  double wall_seconds = 0;
  double particle_updates = 0;
  double bytes_per_particle = 0;
  std::map<std::string, double> phases;  ///< s of wall time
  std::vector<std::string> faults;       ///< sentences
  std::vector<std::string> cite;         ///< papers

  double particle_updates_per_second() const;
};

std::string to_json(const RunRecord& record);

/// Replaces the file in one piece. Throws RunFault.
void write_record(const std::filesystem::path& path, const RunRecord& record);

/// As write_record, for a run that ends because the disk is full: where no second file fits, the
/// old one is written over. Never throws; false if even that failed.
bool write_last_record(const std::filesystem::path& path, const RunRecord& record);

/// Adds the wall time, updates and phases of the run so far, read from its run.json; nothing if
/// that cannot be read, for a continued run does not depend on it.
void add_former_times(RunRecord& record, const std::filesystem::path& path);

}  // namespace scree
