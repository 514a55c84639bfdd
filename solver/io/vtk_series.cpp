// SPDX-License-Identifier: Apache-2.0
#include "solver/io/vtk_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/vtk_frame.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

constexpr const char* frames_folder = "frames";

/// The number of the frame in a file name `series`_NNNNNN.vtu or `series`_[lattice_]NNNNNN.vti, if
/// it is one. Names of other series may begin with that of this one.
std::optional<std::size_t> frame_number(const std::string& file, const std::string& series) {
  if (!file.starts_with(series + "_")) return std::nullopt;
  std::string rest = file.substr(series.size() + 1);
  for (const std::string lattice : {"minus_", "plus_"}) {
    if (rest.starts_with(lattice) && rest.ends_with(".vti")) rest = rest.substr(lattice.size());
  }
  if (!rest.ends_with(".vtu") && !rest.ends_with(".vti")) return std::nullopt;
  std::size_t number = 0;
  const char* end = rest.data() + rest.size() - 4;
  const auto result = std::from_chars(rest.data(), end, number);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return number;
}

}  // namespace

VtkSeries::VtkSeries(fs::path run_folder, std::string name, FramePrecision precision)
    : folder_(std::move(run_folder)), name_(std::move(name)), precision_(precision) {}

void VtkSeries::add(const ParticleSnapshot& snapshot) {
  const std::string file = fmt::format("{}/{}_{:06}.vtu", frames_folder, name_, times_.size());
  write_particle_frame(folder_ / file, snapshot, precision_);
  times_.push_back(snapshot.time);
  files_.push_back({file});
  write_collection();
}

void VtkSeries::add(const std::vector<GridSnapshot>& lattices) {
  if (lattices.empty()) return;
  std::vector<std::string> files;
  for (const GridSnapshot& lattice : lattices) {
    const std::string infix = lattice.lattice == "nodes" ? "" : lattice.lattice + "_";
    files.push_back(fmt::format("{}/{}_{}{:06}.vti", frames_folder, name_, infix, times_.size()));
    write_grid_frame(folder_ / files.back(), lattice, precision_);
  }
  times_.push_back(lattices.front().time);
  files_.push_back(std::move(files));
  write_collection();
}

void VtkSeries::save(StateWriter& writer, const std::string& prefix) const {
  writer.put(prefix + "times", times_);
}

void VtkSeries::resume(const StateReader& reader, const std::string& prefix) {
  resume(reader.get<double>(prefix + "times"));
}

void VtkSeries::resume(const std::vector<double>& times) {
  std::vector<std::vector<std::string>> found(times.size());
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(folder_ / frames_folder)) {
    const std::string file = entry.path().filename().string();
    const bool half = file.ends_with(".tmp");  // left by a kill
    const std::optional<std::size_t> number =
        frame_number(half ? file.substr(0, file.size() - 4) : file, name_);
    if (half && number) later.push_back(entry.path());
    if (half) continue;
    if (!number) continue;
    if (*number < times.size()) {
      found[*number].push_back(std::string(frames_folder) + "/" + file);
    } else {
      later.push_back(entry.path());
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) {
      throw RunFault(fmt::format("cannot continue: frame {} of {} is missing in {}", i, name_,
                                 (folder_ / frames_folder).string()));
    }
    std::sort(found[i].begin(), found[i].end());  // "minus" before "plus", as they are written
  }
  times_ = times;
  files_ = std::move(found);
  // First the collection, then the files: it never names a file that is not there.
  if (!times_.empty() || !later.empty()) write_collection();
  for (const fs::path& file : later) fs::remove(file);
}

std::string VtkSeries::last_file() const {
  return files_.empty() ? std::string() : files_.back().front();
}

void VtkSeries::write_collection() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (std::size_t i = 0; i < times_.size(); ++i) {
    for (std::size_t part = 0; part < files_[i].size(); ++part) {
      text += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", times_[i],
                          part, files_[i][part]);
    }
  }
  text += "  </Collection>\n</VTKFile>\n";
  replace_file(folder_ / (name_ + ".pvd"), text);
}

}  // namespace scree
