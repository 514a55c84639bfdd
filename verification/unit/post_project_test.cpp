// SPDX-License-Identifier: Apache-2.0
// The projection of particle fields to a grid: what it keeps and how fast it converges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "postproc/project/grid_file.hpp"
#include "postproc/project/projection.hpp"
#include "solver/base/error.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/synthetic_run.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

constexpr double pi = 3.14159265358979323846;

Lattice unit_lattice(int dimension, int cells) {
  Lattice lattice;
  lattice.dimension = dimension;
  lattice.spacing = 1.0 / cells;
  lattice.cells = {cells, cells, dimension == 3 ? cells : 1};
  return lattice;
}

ProjectionOptions with_stabilization() {
  ProjectionOptions options;
  options.terms.stabilization = 1e-2;
  options.solver.tolerance = 1e-13;
  return options;
}

std::vector<double> equal_volumes(const ParticleSnapshot& snapshot, double spacing) {
  return std::vector<double>(snapshot.id.size(), std::pow(spacing, snapshot.dimension));
}

/// A body off the lattice's lines, so that cells at its edge are filled in part.
ParticleSnapshot skew_body(int dimension, double spacing) {
  const double z = dimension == 3 ? 0.71 : 0.0;
  return lattice_particles({{0.13, 0.11, 0.09}, {0.81, 0.77, z}}, spacing, dimension, 0.3);
}

class ProjectionIn : public ::testing::TestWithParam<int> {};

TEST_P(ProjectionIn, ReproducesLinearFunctions) {
  const int dimension = GetParam();
  const auto linear = [](const double* x) { return 1 + 2 * x[0] - 3 * x[1] + 4 * x[2]; };
  ParticleSnapshot body = skew_body(dimension, 1.0 / 30);
  add_field(body, "linear", linear);
  for (const double stabilization : {0.0, 1e-2}) {
    ProjectionOptions options = with_stabilization();
    options.terms.stabilization = stabilization;
    const Lattice lattice = unit_lattice(dimension, 10);
    const Projection result = project_fields(lattice, body, equal_volumes(body, 1.0 / 30), options);
    for (std::size_t p = 0; p < body.id.size(); ++p) {
      const double* x = &body.position[3 * p];
      // The residual is 1e-13 of the right-hand side; nodes at the edge, whose entries of the
      // matrix are down to 1e-5 of those inside, magnify it.
      EXPECT_NEAR(interpolate(lattice, result.fields[0].values, x), linear(x), 1e-8);
    }
  }
}

TEST_P(ProjectionIn, ConservesTheIntegralWithEveryTerm) {
  const int dimension = GetParam();
  ParticleSnapshot body = skew_body(dimension, 1.0 / 30);
  std::mt19937_64 random(7);
  add_field(body, "rough", [&](const double*) { return uniform(random); });
  const double volume = std::pow(1.0 / 30, dimension);
  double sum = 0;
  for (const double value : body.fields[0].values) sum += volume * value;
  for (const double length : {0.0, 0.2}) {
    for (const bool lumped : {false, true}) {
      ProjectionOptions options = with_stabilization();
      options.terms.smoothing_length = length;
      options.solver.tolerance = 1e-10;
      options.lumped = lumped;
      const Projection result =
          project_fields(unit_lattice(dimension, 10), body, equal_volumes(body, 1.0 / 30), options);
      double on_grid = 0;
      for (std::size_t n = 0; n < result.volume.size(); ++n) {
        on_grid += result.volume[n] * result.fields[0].values[n];
      }
      // The field's size is 1; the residual's share of the sum is far below the promised 1e-6.
      EXPECT_NEAR(on_grid, sum, 1e-8 * volume * static_cast<double>(body.id.size()));
      EXPECT_LT(result.reports[0].error, 1e-8);
      EXPECT_NEAR(result.reports[0].particle_sum, sum, 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ProjectionIn, ::testing::Values(2, 3));

/// The largest error at the particles.
double error_of(int cells, bool lumped) {
  const auto f = [](const double* x) { return std::sin(2 * x[0]) * std::cos(3 * x[1]); };
  const double spacing = 1.0 / (3 * cells);
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {1, 1, 0}}, spacing, 2);
  add_field(body, "f", f);
  ProjectionOptions options = with_stabilization();
  options.lumped = lumped;
  const Lattice lattice = unit_lattice(2, cells);
  const Projection result = project_fields(lattice, body, equal_volumes(body, spacing), options);
  double largest = 0;
  for (std::size_t p = 0; p < body.id.size(); ++p) {
    const double* x = &body.position[3 * p];
    largest = std::max(largest, std::abs(interpolate(lattice, result.fields[0].values, x) - f(x)));
  }
  return largest;
}

TEST(Projection, TheConsistentOneIsOfSecondOrderAndTheLumpedOneOfFirst) {
  const double consistent = std::log2(error_of(16, false) / error_of(32, false));
  const double lumped = std::log2(error_of(16, true) / error_of(32, true));
  EXPECT_NEAR(consistent, 2, 0.15);  // a smooth function on 16 and 32 cells
  EXPECT_NEAR(lumped, 1, 0.15);      // at the edge the mean lies a third of a cell inside
}

TEST(Projection, SmoothingDampsAWaveAsTheHelmholtzFilterDoes) {
  const double length = 0.1, k = 3 * pi, spacing = 1.0 / 120;
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {1, 1, 0}}, spacing, 2);
  add_field(body, "wave", [&](const double* x) { return std::cos(k * x[0]); });
  ProjectionOptions options = with_stabilization();
  options.terms.smoothing_length = length;
  const Lattice lattice = unit_lattice(2, 60);
  const Projection result = project_fields(lattice, body, equal_volumes(body, spacing), options);
  const double factor = 1 / (1 + length * length * k * k);
  const double x[3] = {1.0 / 3, 0.5, 0};
  // (k h)^2/12 = 2e-3 is the error of linear cells.
  EXPECT_NEAR(interpolate(lattice, result.fields[0].values, x), factor * std::cos(k * x[0]), 2e-3);
}

TEST(Projection, ParticlesWithoutAValueAreLeftOutOfThatFieldOnly) {
  ParticleSnapshot body = lattice_particles({{0, 0, 0}, {1, 1, 0}}, 0.05, 2);
  add_field(body, "all", [](const double*) { return 3.0; });
  add_field(body, "half", [](const double* x) {
    return x[0] < 0.5 ? 7.0 : std::numeric_limits<double>::quiet_NaN();
  });
  const Lattice lattice = unit_lattice(2, 10);
  const Projection result =
      project_fields(lattice, body, equal_volumes(body, 0.05), with_stabilization());
  EXPECT_EQ(result.reports[0].left_out, 0u);
  EXPECT_EQ(result.reports[1].left_out, body.id.size() / 2);
  const double left[3] = {0.2, 0.2, 0}, right[3] = {0.9, 0.2, 0};
  EXPECT_NEAR(interpolate(lattice, result.fields[0].values, right), 3, 1e-9);  // the solver's
  EXPECT_NEAR(interpolate(lattice, result.fields[1].values, left), 7, 1e-9);   // tolerance
  EXPECT_EQ(interpolate(lattice, result.fields[1].values, right), 0);
}

TEST(Projection, ASolverThatDoesNotConvergeIsAFault) {
  ParticleSnapshot body = skew_body(2, 1.0 / 30);
  add_field(body, "f", [](const double* x) { return std::sin(20 * x[0]); });
  ProjectionOptions options = with_stabilization();
  options.solver.most_iterations = 2;
  try {
    project_fields(unit_lattice(2, 10), body, equal_volumes(body, 1.0 / 30), options);
    FAIL() << "2 iterations cannot suffice";
  } catch (const RunFault& fault) {
    const std::string sentence = fault.what();
    EXPECT_NE(sentence.find("DIVERGED_ITS after 2 iterations"), std::string::npos) << sentence;
  }
}

TEST(ProjectionFile, AFullDiskLeavesNothing) {
  const Lattice lattice = unit_lattice(2, 10);
  const ParticleSnapshot body = skew_body(2, 1.0 / 30);
  const Projection result =
      project_fields(lattice, body, equal_volumes(body, 1.0 / 30), with_stabilization());
  for (const char* name : {"grid.vti", "grid.vtu", "grid.xdmf"}) {
    const TemporaryFolder folder;
    {
      const FileSizeLimit limit(1000);
      EXPECT_THROW(write_grid_file((folder / name).string(), result, 0.0), RunFault) << name;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << name;
    write_grid_file((folder / name).string(), result, 0.0);
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
}

}  // namespace
}  // namespace scree
