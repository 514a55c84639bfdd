// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include "solver/io/vtk_frame.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {

using Box = std::pair<std::array<double, 3>, std::array<double, 3>>;  ///< lower, upper [m]

/// Uniform in [-1, 1).
inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

/// Particles at the centres of the cells of a lattice that fills a box, each moved by up to
/// `jitter` spacings.
inline ParticleSnapshot lattice_particles(const Box& box, double spacing, int dimension,
                                          double jitter = 0) {
  ParticleSnapshot snapshot;
  snapshot.dimension = dimension;
  std::mt19937_64 random(1);
  std::array<int, 3> count{1, 1, 1};
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    count[a] = static_cast<int>((box.second[a] - box.first[a]) / spacing + 0.5);
  }
  for (int k = 0; k < count[2]; ++k) {
    for (int j = 0; j < count[1]; ++j) {
      for (int i = 0; i < count[0]; ++i) {
        const std::array<int, 3> at{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          const double x = box.first[a] + spacing * (at[a] + 0.5 + jitter * uniform(random));
          snapshot.position.push_back(a < static_cast<std::size_t>(dimension) ? x : 0);
        }
        snapshot.id.push_back(static_cast<std::int64_t>(snapshot.id.size()));
      }
    }
  }
  snapshot.material.assign(snapshot.id.size(), 0);
  snapshot.body.assign(snapshot.id.size(), 0);
  return snapshot;
}

/// Adds a field of one component that is a function of the place.
inline void add_field(ParticleSnapshot& snapshot, const std::string& name,
                      const std::function<double(const double*)>& f) {
  SnapshotField field{name, "", 1, {}};
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    field.values.push_back(f(&snapshot.position[3 * p]));
  }
  snapshot.fields.push_back(std::move(field));
}

/// A run folder whose frames come from a test, through the writers of real runs.
class SyntheticRun {
 public:
  SyntheticRun(int dimension, const std::array<double, 3>& upper, double cell_size,
               int particles_per_direction = 2, const std::string& more = "") {
    std::filesystem::create_directory(folder_ / "frames");
    std::string lower_text, upper_text, gravity_text;
    for (int a = 0; a < dimension; ++a) {
      lower_text += a > 0 ? ", 0.0" : "0.0";
      upper_text += fmt::format("{}{:.17g}", a > 0 ? ", " : "", upper[static_cast<std::size_t>(a)]);
      gravity_text += fmt::format("{}{}", a > 0 ? ", " : "", a + 1 == dimension ? "-10.0" : "0.0");
    }
    write_text(folder_ / "resolved.toml",
               fmt::format("title = \"Synthetic\"\n[domain]\ndimension = {}\nlower = [{}]\n"
                           "upper = [{}]\ncell_size = {:.17g}\n[time]\nend = 1.0\n[method]\n"
                           "gravity = [{}]\n[body.one]\nparticles_per_direction = {}\n{}",
                           dimension, lower_text, upper_text, cell_size, gravity_text,
                           particles_per_direction, more));
    write_text(folder_ / "run.json", "{\"status\": \"done\"}\n");
  }

  /// Writes the next frame and lists it.
  void add(ParticleSnapshot snapshot, double time) {
    snapshot.time = time;
    const std::string file = fmt::format("frames/particles_{:06}.vtu", count_++);
    write_particle_frame(folder_ / file, snapshot, FramePrecision::double_);
    list_ += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, file);
    write_text(folder_ / "particles.pvd",
               "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n" + list_ +
                   "</Collection></VTKFile>\n");
  }

  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
  int count_ = 0;
  std::string list_;
};

}  // namespace scree
