// SPDX-License-Identifier: Apache-2.0
#include "app/bench_case.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "materials/typical_input.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

constexpr double cell_size = 1.0 / 64;
constexpr int per_direction = 2;
constexpr int margin = 4;  ///< free cells around the body

template <class T>
T choose(const std::string& option, const std::string& value,
         const std::map<std::string, T>& known) {
  const auto it = known.find(value);
  if (it != known.end()) return it->second;
  std::string names;
  for (const auto& [name, unused] : known) names += (names.empty() ? "" : ", ") + name;
  throw UserError("--" + option + " " + value + ": unknown; allowed: " + names);
}

/// Cells an axis of a body with `particles` particles, in the proportions of `shape`.
std::array<std::int32_t, 3> body_cells(std::int64_t particles, const std::array<double, 3>& shape) {
  const double volume = double(particles) / (per_direction * per_direction * per_direction);
  const double unit = std::cbrt(volume / (shape[0] * shape[1] * shape[2]));
  std::array<std::int32_t, 3> cells{};
  for (std::size_t a = 0; a < 3; ++a) {
    cells[a] = std::max<std::int32_t>(1, std::int32_t(std::lround(unit * shape[a])));
  }
  return cells;
}

/// Fills a box of cells that begins at `first` with particles.
void fill(BodySetup& body, const std::array<std::int32_t, 3>& first,
          const std::array<std::int32_t, 3>& cells) {
  const double spacing = cell_size / per_direction;
  body.particle_volume = spacing * spacing * spacing;
  body.position.reserve(std::size_t(3 * per_direction * per_direction * per_direction) *
                        std::size_t(cells[0]) * std::size_t(cells[1]) * std::size_t(cells[2]));
  for (int i = 0; i < cells[0] * per_direction; ++i) {
    for (int j = 0; j < cells[1] * per_direction; ++j) {
      for (int k = 0; k < cells[2] * per_direction; ++k) {
        body.position.push_back(first[0] * cell_size + (i + 0.5) * spacing);
        body.position.push_back(first[1] * cell_size + (j + 0.5) * spacing);
        body.position.push_back(first[2] * cell_size + (k + 0.5) * spacing);
      }
    }
  }
}

/// A body of a law with these parameters, at rest; `cells` of particles from cell `first` on.
BodySetup make_body(const std::string& model, double density, const NumberKeys& values,
                    const std::array<std::int32_t, 3>& first,
                    const std::array<std::int32_t, 3>& cells) {
  const MaterialEntry* entry = find_material_model(model);
  if (entry == nullptr) throw UserError("this build has no material " + model);
  BodySetup body;
  body.model = model;
  body.density = density;
  body.input = typical_input(*entry, 3, values);
  fill(body, first, cells);
  return body;
}

std::array<double, 3> weight(double) { return {0, -9.81, 0}; }

SimulationSetup elastic_case(std::int64_t particles) {
  SimulationSetup setup;
  const auto cells = body_cells(particles, {1, 1, 1});
  for (std::size_t a = 0; a < 3; ++a) setup.cells[a] = cells[a] + 2 * margin;
  BodySetup body = make_body("fixed_corotated", 1000, {{"youngs_modulus", 1e6}},
                             {margin, margin, margin}, cells);
  const double k = 2 * std::numbers::pi / (cells[0] * cell_size);
  body.velocity.reserve(body.position.size());
  for (std::size_t p = 0; p < body.position.size(); p += 3) {
    for (std::size_t a = 0; a < 3; ++a) {
      body.velocity.push_back(0.5 * std::sin(k * body.position[p + (a + 1) % 3]));
    }
  }
  setup.bodies.push_back(std::move(body));
  return setup;
}

SimulationSetup sand_case(std::int64_t particles) {
  SimulationSetup setup;
  const auto cells = body_cells(particles, {1, 1.6, 1});
  setup.cells = {cells[0] + 2 * cells[0] / 2, cells[1] + margin, cells[2] + 2 * cells[2] / 2};
  const double friction = 31 * std::numbers::pi / 180;
  setup.bodies.push_back(make_body("drucker_prager", 1600,
                                   {{"youngs_modulus", 2e6}, {"friction_angle", friction}},
                                   {cells[0] / 2, 0, cells[2] / 2}, cells));
  setup.faces[1][0] = FaceType::sticky;
  setup.gravity = weight;
  return setup;
}

SimulationSetup fluid_case(std::int64_t particles) {
  SimulationSetup setup;
  const auto cells = body_cells(particles, {1, 1, 1});
  setup.cells = {2 * cells[0], cells[1] + margin, cells[2]};
  setup.bodies.push_back(make_body("j_fluid", 1000, {{"bulk_modulus", 1e5}}, {0, 0, 0}, cells));
  setup.faces = {{{FaceType::slip, FaceType::slip},
                  {FaceType::slip, FaceType::slip},
                  {FaceType::slip, FaceType::slip}}};
  setup.gravity = weight;
  return setup;
}

}  // namespace

SimulationSetup build_bench_case(const BenchOptions& options) {
  using Builder = SimulationSetup (*)(std::int64_t);
  const std::map<std::string, Builder> cases{
      {"elastic", elastic_case}, {"sand", sand_case}, {"fluid", fluid_case}};
  const std::map<std::string, KernelType> kernels{{"compact", KernelType::compact},
                                                  {"quadratic", KernelType::quadratic}};
  const std::map<std::string, Precision> precisions{{"double", Precision::double_},
                                                    {"single", Precision::single_}};
  const std::map<std::string, PathType> paths{{"fused", PathType::fused},
                                              {"split", PathType::split}};
  if (options.particles < 1) throw UserError("--particles must be at least 1");
  SimulationSetup setup = choose("case", options.case_name, cases)(options.particles);
  setup.bodies[0].name = setup.bodies[0].material = options.case_name;
  setup.cell_size = cell_size;
  setup.kernel = choose("kernel", options.kernel, kernels);
  setup.precision = choose("precision", options.precision, precisions);
  setup.path = choose("path", options.path, paths);
  setup.schedule = Schedule(1e6, 0, 0, 0);
  setup.record = false;
  setup.keep_reference = false;
  return setup;
}

}  // namespace scree
