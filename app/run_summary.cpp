// SPDX-License-Identifier: Apache-2.0
#include "app/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "app/progress.hpp"

namespace scree {

namespace {

void add_line(std::string& text, const char* name, const std::string& value) {
  fmt::format_to(std::back_inserter(text), "  {:<18} {}\n", name, value);
}

/// "transfer 12.1 s, grid 3.0 s": the longest first.
std::string phase_text(const RunRecord& record) {
  std::vector<std::pair<std::string, double>> phases(record.phases.begin(), record.phases.end());
  std::stable_sort(phases.begin(), phases.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> parts;
  parts.reserve(phases.size());
  for (const auto& [name, seconds] : phases)
    parts.push_back(fmt::format("{} {:.2f} s", name, seconds));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::string run_summary(const RunRecord& record, const std::filesystem::path& folder,
                        const std::string& files) {
  std::string text = fmt::format("{}: t = {:.6g} s of {:.6g} s after {} steps\n", record.status,
                                 record.simulated_time, record.end_time, record.steps);
  const std::string left =
      record.removed_particles > 0
          ? fmt::format(" ({} left through open faces)", record.removed_particles)
          : "";
  add_line(text, "particles", fmt::format("{}{}", record.particles, left));
  add_line(text, "wall time",
           fmt::format("{:.1f} s ({})", record.wall_seconds, clock_text(record.wall_seconds)));
  add_line(text, "particle updates",
           fmt::format("{:.3g} a second, {} thread{}", record.particle_updates_per_second(),
                       record.threads, record.threads == 1 ? "" : "s"));
  if (!record.phases.empty()) add_line(text, "phases", phase_text(record));
  if (record.particles > 0) {
    add_line(text, "memory", fmt::format("{:.0f} bytes a particle", record.bytes_per_particle));
  }
  add_line(text, "files", fmt::format("{}: {}", folder.string(), files));
  if (!record.cite.empty()) text += "please cite\n";
  for (const std::string& paper : record.cite) text += "  " + paper + "\n";
  return text;
}

}  // namespace scree
