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
constexpr int margin = 4;  ///< free cells around the body

/// Particles an axis and cell. Soil with water by default has as many as a deck gives the compact
/// kernel.
int per_direction(const BenchOptions& options) {
  if (options.per_direction > 0) return options.per_direction;
  return options.case_name == "coupled" ? 3 : 2;
}

template <class T>
T choose(const std::string& option, const std::string& value,
         const std::map<std::string, T>& known) {
  const auto it = known.find(value);
  if (it != known.end()) return it->second;
  std::string names;
  for (const auto& [name, unused] : known) names += (names.empty() ? "" : ", ") + name;
  throw UserError("--" + option + " " + value + ": unknown; allowed: " + names);
}

/// Cells an axis of a body with `particles` particles, in the proportions of `shape`; in 2D one
/// layer.
std::array<std::int32_t, 3> body_cells(const BenchOptions& options,
                                       const std::array<double, 3>& shape) {
  double cells_in_all = double(options.particles);
  double proportions = 1;
  for (int a = 0; a < options.dimension; ++a) {
    cells_in_all /= per_direction(options);
    proportions *= shape[std::size_t(a)];
  }
  const double unit = std::pow(cells_in_all / proportions, 1.0 / options.dimension);
  std::array<std::int32_t, 3> cells{1, 1, 1};
  for (std::size_t a = 0; a < std::size_t(options.dimension); ++a) {
    cells[a] = std::max<std::int32_t>(1, std::int32_t(std::lround(unit * shape[a])));
  }
  return cells;
}

/// Fills a box of cells that begins at `first` with n particles an axis and cell.
void fill(BodySetup& body, int dimension, int n, const std::array<std::int32_t, 3>& first,
          const std::array<std::int32_t, 3>& cells) {
  const double spacing = cell_size / n;
  const int layers = dimension == 3 ? cells[2] * n : 1;
  body.particle_volume = std::pow(spacing, dimension);
  body.position.reserve(std::size_t(3 * n * n) * std::size_t(cells[0]) * std::size_t(cells[1]) *
                        std::size_t(layers));
  for (int i = 0; i < cells[0] * n; ++i) {
    for (int j = 0; j < cells[1] * n; ++j) {
      for (int k = 0; k < layers; ++k) {
        body.position.push_back(first[0] * cell_size + (i + 0.5) * spacing);
        body.position.push_back(first[1] * cell_size + (j + 0.5) * spacing);
        body.position.push_back(dimension == 3 ? first[2] * cell_size + (k + 0.5) * spacing : 0);
      }
    }
  }
}

/// A body of a law with these parameters, at rest; `cells` of particles from cell `first` on.
BodySetup make_body(const BenchOptions& options, const std::string& model, double density,
                    const NumberKeys& values, const std::array<std::int32_t, 3>& first,
                    const std::array<std::int32_t, 3>& cells) {
  const MaterialEntry* entry = find_material_model(model);
  if (entry == nullptr) throw UserError("this build has no material " + model);
  BodySetup body;
  body.model = model;
  body.density = density;
  body.input = typical_input(*entry, options.dimension, values);
  fill(body, options.dimension, per_direction(options), first, cells);
  return body;
}

std::array<double, 3> weight(double) { return {0, -9.81, 0}; }

SimulationSetup elastic_case(const BenchOptions& options) {
  SimulationSetup setup;
  const auto cells = body_cells(options, {1, 1, 1});
  for (std::size_t a = 0; a < 3; ++a) setup.cells[a] = cells[a] + 2 * margin;
  BodySetup body = make_body(options, "fixed_corotated", 1000, {{"youngs_modulus", 1e6}},
                             {margin, margin, margin}, cells);
  const double k = 2 * std::numbers::pi / (cells[0] * cell_size);
  const std::size_t axes(std::size_t(options.dimension));
  body.velocity.reserve(body.position.size());
  for (std::size_t p = 0; p < body.position.size(); p += 3) {
    for (std::size_t a = 0; a < 3; ++a) {
      body.velocity.push_back(a < axes ? 0.5 * std::sin(k * body.position[p + (a + 1) % axes])
                                       : 0.0);
    }
  }
  setup.bodies.push_back(std::move(body));
  return setup;
}

SimulationSetup sand_case(const BenchOptions& options) {
  SimulationSetup setup;
  const auto cells = body_cells(options, {1, 1.6, 1});
  setup.cells = {cells[0] + 2 * cells[0] / 2, cells[1] + margin, cells[2] + 2 * cells[2] / 2};
  const double friction = 31 * std::numbers::pi / 180;
  setup.bodies.push_back(make_body(options, "drucker_prager", 1600,
                                   {{"youngs_modulus", 2e6}, {"friction_angle", friction}},
                                   {cells[0] / 2, 0, cells[2] / 2}, cells));
  setup.faces[1][0] = FaceType::sticky;
  setup.gravity = weight;
  return setup;
}

SimulationSetup fluid_case(const BenchOptions& options) {
  SimulationSetup setup;
  const auto cells = body_cells(options, {1, 1, 1});
  setup.cells = {2 * cells[0], cells[1] + margin, cells[2]};
  setup.bodies.push_back(
      make_body(options, "j_fluid", 1000, {{"bulk_modulus", 1e5}}, {0, 0, 0}, cells));
  for (std::size_t a = 0; a < std::size_t(options.dimension); ++a) {
    setup.faces[a] = {FaceType::slip, FaceType::slip};
  }
  setup.gravity = weight;
  return setup;
}

/// The upper faces of a body's highest particles.
DrainageSetup drained_top(const BenchOptions& options, const BodySetup& body, double top) {
  const double spacing = cell_size / per_direction(options);
  DrainageSetup drainage;
  drainage.name = "top";
  for (std::size_t p = 0; p < body.position.size(); p += 3) {
    if (body.position[p + 1] < top - spacing) continue;
    DrainedFace face;
    face.particle = std::int64_t(p / 3);
    face.area = {0, std::pow(spacing, options.dimension - 1), 0};
    face.offset = {0, spacing / 2, 0};
    drainage.faces.push_back(face);
  }
  return drainage;
}

SimulationSetup coupled_case(const BenchOptions& options) {
  SimulationSetup setup;
  const auto cells = body_cells(options, {1, 1, 1});
  setup.cells = {cells[0], cells[1] + margin, cells[2]};
  BodySetup body = make_body(options, options.soil, 2000, {{"youngs_modulus", 1e7}}, {}, cells);
  for (std::size_t a = 0; a < std::size_t(options.dimension); ++a) {
    setup.faces[a] = {FaceType::slip, FaceType::slip};
  }
  setup.gravity = weight;
  if (!options.dry) {
    PoreSetup pores;
    pores.porosity = 0.4;
    pores.mobility = 1e-9;  // water in fine sand, 1e-5 m/s
    body.pores = pores;
    setup.coupling.emplace();
    setup.coupling->drainage.push_back(drained_top(options, body, cells[1] * cell_size));
  }
  setup.bodies.push_back(std::move(body));
  return setup;
}

}  // namespace

SimulationSetup build_bench_case(const BenchOptions& options) {
  using Builder = SimulationSetup (*)(const BenchOptions&);
  const std::map<std::string, Builder> cases{{"elastic", elastic_case},
                                             {"sand", sand_case},
                                             {"fluid", fluid_case},
                                             {"coupled", coupled_case}};
  const std::map<std::string, KernelType> kernels{{"compact", KernelType::compact},
                                                  {"quadratic", KernelType::quadratic}};
  const std::map<std::string, Precision> precisions{{"double", Precision::double_},
                                                    {"single", Precision::single_}};
  const std::map<std::string, PathType> paths{
      {"automatic", PathType::automatic}, {"fused", PathType::fused}, {"split", PathType::split}};
  if (options.particles < 1) throw UserError("--particles must be at least 1");
  if (options.dimension != 2 && options.dimension != 3) {
    throw UserError("--dimension must be 2 or 3");
  }
  SimulationSetup setup = choose("case", options.case_name, cases)(options);
  setup.dimension = options.dimension;
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
