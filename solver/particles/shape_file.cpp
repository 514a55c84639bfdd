// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "solver/geometry/height_raster.hpp"
#include "solver/geometry/mesh_file.hpp"
#include "solver/geometry/mesh_solid.hpp"
#include "solver/particles/shape_heightmap.hpp"
#include "solver/particles/shape_mesh.hpp"

namespace scree {
namespace {

/// The file as it is now: another version of it is another file.
std::string file_state(const std::string& path) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  const auto time = std::filesystem::last_write_time(path, none).time_since_epoch().count();
  return fmt::format("{}|{}|{}", path, size, time);
}

/// What `make` gives for the key, made once.
template <class T, class Make>
std::shared_ptr<const T> remembered(const std::string& key, Make make) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const T>> known;
  const std::lock_guard lock(mutex);
  auto found = known.find(key);
  if (found == known.end()) found = known.emplace(key, make()).first;
  return found->second;
}

std::shared_ptr<const MeshSolid> load_mesh(const ShapeSpec& spec) {
  const auto &t = spec.translate, &e = spec.extrude;
  const RotationSpec turn = spec.rotate.value_or(RotationSpec{});
  const std::string key = fmt::format(
      "{}|{}|{}|{} {} {} {}|{} {} {}|{} {} {}", file_state(spec.file), spec.region, spec.scale,
      turn.axis[0], turn.axis[1], turn.axis[2], turn.angle, t[0], t[1], t[2], e[0], e[1], e[2]);
  return remembered<MeshSolid>(key, [&] {
    TriangleMesh mesh = read_mesh_file(spec.file, spec.region);
    const Placement place{spec.scale, turn.axis, turn.angle, spec.translate};
    for (auto& point : mesh.points) point = place(point);
    return std::make_shared<const MeshSolid>(std::move(mesh), spec.extrude);
  });
}

std::shared_ptr<const HeightRaster> load_raster(const ShapeSpec& spec, bool placed) {
  const std::array<double, 3> shift = placed ? spec.translate : std::array<double, 3>{};
  const std::string key =
      fmt::format("{}|{}|{} {} {}|{}", file_state(spec.file), spec.scale, shift[0], shift[1],
                  shift[2], spec.no_data ? fmt::format("{}", *spec.no_data) : std::string());
  return remembered<HeightRaster>(key, [&] {
    return std::make_shared<const HeightRaster>(
        read_esri_raster(spec.file, spec.scale, shift, spec.no_data));
  });
}

/// In 2D, x along the section and y up.
HeightProfile load_profile(const ShapeSpec& spec) {
  const auto raster = load_raster(spec, false);
  if (spec.section.empty() && raster->rows() > 1)
    throw GeometryFault("section", fmt::format("is needed where a raster has {} rows; add section "
                                               "= [[x, y], [x, y]], the ends of a line on the map",
                                               raster->rows()));
  const auto end = [&](std::size_t i) {
    return std::array<double, 2>{spec.scale * spec.section[i][0], spec.scale * spec.section[i][1]};
  };
  if (!spec.section.empty())
    for (const auto& point : {end(0), end(1)})
      for (std::size_t a = 0; a < 2; ++a)
        if (point[a] < raster->lower()[a] || point[a] > raster->upper()[a])
          throw GeometryFault(
              "section",
              fmt::format("leaves the raster, which reaches from ({:.9g}, "
                          "{:.9g}) to ({:.9g}, {:.9g})",
                          raster->lower()[0] / spec.scale, raster->lower()[1] / spec.scale,
                          raster->upper()[0] / spec.scale, raster->upper()[1] / spec.scale));
  HeightProfile profile =
      spec.section.empty() ? HeightProfile(*raster) : HeightProfile(*raster, end(0), end(1));
  profile.move(spec.translate[0], spec.translate[1]);
  return profile;
}

void check_base(double base, double lowest, const std::string& place) {
  if (base < lowest) return;
  throw GeometryFault(
      "base",
      fmt::format("must lie below the surface, which comes down to {:.9g} m{}", lowest, place));
}

std::optional<ShapeProblem> section_problem(const ShapeSpec& spec) {
  if (spec.section.empty()) return std::nullopt;
  if (spec.section.size() != 2)
    return ShapeProblem{"section", "must be two points, the ends of a straight line"};
  if (spec.section[0] == spec.section[1])
    return ShapeProblem{"section", "must be two different points"};
  return std::nullopt;
}

}  // namespace

std::unique_ptr<Shape> make_file_shape(const ShapeSpec& spec, int dimension) {
  if (spec.kind == ShapeKind::mesh) return std::make_unique<MeshShape>(load_mesh(spec));
  if (dimension == 2) {
    HeightProfile profile = load_profile(spec);
    check_base(spec.base, profile.lowest(), "");
    return std::make_unique<ProfileShape>(std::move(profile), spec.base);
  }
  const auto raster = load_raster(spec, true);
  const auto place = raster->lowest_place();
  check_base(spec.base, raster->lowest(), fmt::format(" at ({:.9g}, {:.9g})", place[0], place[1]));
  return std::make_unique<TerrainShape>(raster, spec.base);
}

std::optional<ShapeProblem> find_file_problem(const ShapeSpec& spec, int dimension) {
  const bool mesh = spec.kind == ShapeKind::mesh;
  if (mesh && dimension == 2)
    return ShapeProblem{"type",
                        "a mesh bounds a solid of three dimensions; with domain.dimension = 2 "
                        "give the outline as a polygon"};
  if (mesh && spec.rotate && spec.rotate->axis == std::array<double, 3>{})
    return ShapeProblem{"rotate", "its axis must not be zero"};
  if (auto problem = section_problem(spec)) return problem;
  try {
    make_file_shape(spec, dimension);
  } catch (const GeometryFault& fault) {
    return ShapeProblem{fault.key(), fault.what()};
  }
  return std::nullopt;
}

double file_shape_volume(const ShapeSpec& spec, int dimension) {
  if (spec.kind == ShapeKind::mesh) return load_mesh(spec)->volume();
  if (dimension == 2) {
    const HeightProfile profile = load_profile(spec);
    return profile.integral() - spec.base * (profile.upper() - profile.lower());
  }
  const auto raster = load_raster(spec, true);
  const double area =
      (raster->upper()[0] - raster->lower()[0]) * (raster->upper()[1] - raster->lower()[1]);
  return raster->integral() - spec.base * area;
}

}  // namespace scree
