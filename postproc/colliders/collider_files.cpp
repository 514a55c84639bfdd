// SPDX-License-Identifier: Apache-2.0
#include "postproc/colliders/collider_files.hpp"

#include <fmt/format.h>

#include "postproc/colliders/run_colliders.hpp"
#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw RunFault(write_failure(folder, error.value()));
}

}  // namespace

ColliderFiles write_colliders(const Run& run, const std::vector<double>& times,
                              const fs::path& index, const std::function<void(std::size_t)>& done) {
  const std::vector<RunCollider> colliders = run_colliders(run, times);
  ColliderFiles written;
  written.colliders = colliders.size();
  const std::string folder = index.stem().string() + "_files";
  if (!colliders.empty()) make_folder(index.parent_path() / folder);
  std::string list;
  for (std::size_t k = 0; k < times.size(); ++k) {
    for (std::size_t part = 0; part < colliders.size(); ++part) {
      // A deck may name colliders with any characters: files have numbers.
      const RunCollider& collider = colliders[part];
      const std::size_t at = collider.moves() ? k : 0;
      const std::string file = collider.moves() ? fmt::format("{}/{:02}_{:06}.vtp", folder, part, k)
                                                : fmt::format("{}/{:02}.vtp", folder, part);
      if (at == k) {
        write_mesh(collider.surface(k), (index.parent_path() / file).string());
        ++written.files;
      }
      list +=
          fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", times[k], part, file);
    }
    if (done) done(k + 1);
  }
  for (const RunCollider& collider : colliders) written.moving += collider.moves() ? 1 : 0;
  replace_file(index, "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n" + list +
                          "</Collection></VTKFile>\n");
  return written;
}

}  // namespace scree
