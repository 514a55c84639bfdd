// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "solver/base/problems.hpp"

namespace scree {
namespace {

std::string lower_case_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

void check_readable(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw GeometryFault("file", "is a folder, not a file: " + path);
  errno = 0;
  if (std::ifstream(path).good()) return;
  throw GeometryFault("file", "cannot be read: " + path + ": " + std::strerror(errno) +
                                  "; relative paths start at the deck's folder");
}

}  // namespace

std::string read_geometry_file(const std::string& path) {
  check_readable(path);
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void unknown_region(const std::string& region, std::vector<std::string> known) {
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  if (known.empty()) throw GeometryFault("region", "the file names no regions; remove this key");
  const std::string near = did_you_mean(region, known);
  throw GeometryFault("region",
                      "is not in the file, which has " + join(known) +
                          (near.empty() ? std::string() : "; did you mean \"" + near + "\"?"));
}

TriangleMesh read_mesh_file(const std::string& path, const std::string& region) {
  check_readable(path);
  const std::string ending = lower_case_ending(path);
  if (ending == ".stl") return read_stl(path, region);
  if (ending == ".obj") return read_obj(path, region);
  if (ending == ".ply" || ending == ".vtp" || ending == ".vtu") return read_with_vtk(path, region);
  return read_with_meshio(path, region);
}

}  // namespace scree
