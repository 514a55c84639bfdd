// SPDX-License-Identifier: Apache-2.0
//
// volumetric_locking = "fbar": what averaging the changes of volume must keep, reproduce and leave
// alone.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/error.hpp"
#include "solver/exec/strict_group.hpp"
#include "solver/grid/node_means.hpp"
#include "solver/step/volume_bodies.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"
#include "verification/support/block_scene.hpp"
#include "verification/support/final_state.hpp"
#include "verification/support/random.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<Method> split_methods() {
  std::vector<Method> methods = all_methods();
  std::erase_if(methods, [](const Method& m) { return m.path == PathType::fused; });
  return methods;
}

std::vector<Vector> jittered_points(int dimension, Random& random) {
  auto points = lattice(Vector(0.5, 0.5, 0.5), Vector(0.9, 0.9, 0.8), dx / 2, dimension);
  for (Vector& x : points) x += random.vector(0.2 * dx / 2, dimension);
  return points;
}

/// Jittered jelly far from the faces of an open domain, every particle already compressed or
/// stretched by up to a tenth an axis and with velocities of its own.
SimulationSetup random_motion(int dimension, const Method& method, VolumetricLocking locking) {
  SimulationSetup setup = make_setup(dimension, method, dx, {14, 14, 14});
  setup.volumetric_locking = locking;
  Random random(61);
  BodySetup& body = add_jelly(setup, jittered_points(dimension, random), dx / 2, {});
  for (std::size_t p = 0; p < body.position.size() / 3; ++p) {
    const Vector v = Vector(0.3, 0.1, 0.2) + random.vector(0.5, dimension);
    const Matrix L = random.matrix(4.0, dimension);
    for (int c = 0; c < 3; ++c) body.velocity.push_back(c < dimension ? v[c] : 0.0);
    for (int i = 0; i < 9; ++i) body.velocity_gradient.push_back(L(i / 3, i % 3));
    std::vector<double> F(9, 0.0);
    for (int a = 0; a < 3; ++a) {
      F[4 * std::size_t(a)] = 1 + (a < dimension ? random.uniform(-0.1, 0.1) : 0);
    }
    body.states.push_back(F);
    body.state_of.push_back(std::int32_t(p));
  }
  return setup;
}

State after(SimulationSetup setup, int steps, double dt) {
  set_steps(setup, steps, dt);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  return state_of(*simulation);
}

double sum_of_volume_ratios(const State& state) {
  double sum = 0;
  for (const Matrix& F : state.F) sum += F.determinant();
  return sum;
}

class VolumeAveraging : public ::testing::TestWithParam<Method> {};

TEST_P(VolumeAveraging, total_change_of_volume_stays) {
  for (int dimension : {2, 3}) {
    const auto none = after(random_motion(dimension, GetParam(), VolumetricLocking::none), 1, 5e-4);
    const auto fbar = after(random_motion(dimension, GetParam(), VolumetricLocking::fbar), 1, 5e-4);
    const double count = double(none.F.size());
    // Rounding of sums over the particles.
    EXPECT_NEAR(sum_of_volume_ratios(none), sum_of_volume_ratios(fbar), 10 * epsilon * count);
    EXPECT_EQ(distance(none.x, fbar.x), 0);  // the first step's forces are the same
    EXPECT_EQ(distance(none.v, fbar.v), 0);
    double own = 0, shear = 0;
    for (std::size_t p = 0; p < none.F.size(); ++p) {
      const double a = none.F[p].determinant(), b = fbar.F[p].determinant();
      own = std::max(own, std::abs(a - b));
      const Matrix A = none.F[p] / std::pow(a, 1.0 / dimension);
      const Matrix B = fbar.F[p] / std::pow(b, 1.0 / dimension);
      for (int i = 0; i < dimension * dimension; ++i) {
        const int r = i / dimension, c = i % dimension;
        shear = std::max(shear, std::abs(A(r, c) - B(r, c)));
      }
      EXPECT_TRUE(dimension == 3 || fbar.F[p](2, 2) == none.F[p](2, 2));  // plane strain stays
    }
    EXPECT_GT(own, 1e-5);            // of changes of volume of about 4 5e-4
    EXPECT_LT(shear, 10 * epsilon);  // the distortion is the particle's own: rounding
  }
}

TEST_P(VolumeAveraging, momentum_is_kept) {
  for (int dimension : {2, 3}) {
    SimulationSetup setup = random_motion(dimension, GetParam(), VolumetricLocking::fbar);
    set_steps(setup, 25, 2e-4, true);
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    const auto rows = run_with_history(*simulation, schedule);
    const double mass = rows[0].mass;
    for (const HistoryRow& row : rows) {
      for (int a = 0; a < 3; ++a) {
        // A rounding a step; of 1 m and 1 m/s for the angular momentum.
        EXPECT_NEAR(row.momentum[a], rows[0].momentum[a], 25 * 2e-15 * mass);
        if (!GetParam().affine()) continue;
        EXPECT_NEAR(row.angular_momentum[a], rows[0].angular_momentum[a], 25 * 4e-15 * mass);
      }
    }
  }
}

TEST_P(VolumeAveraging, homogeneous_deformation_is_that_without) {
  if (!GetParam().affine()) return;  // pic and flip do not gather a linear field at free edges
  for (int dimension : {2, 3}) {
    State states[2];
    for (const bool averaged : {false, true}) {
      SimulationSetup setup = make_setup(dimension, GetParam(), dx, {14, 14, 14});
      if (averaged) setup.volumetric_locking = VolumetricLocking::fbar;
      Random random(62);
      BodySetup& body = add_jelly(setup, jittered_points(dimension, random), dx / 2, {});
      const Matrix L = random.matrix(2.0, dimension);
      set_velocity(body, random.vector(1.0, dimension), L);
      states[averaged] = after(std::move(setup), 1, 1e-3);
    }
    EXPECT_LT(distance(states[0].F, states[1].F), 10 * epsilon);  // rounding
    EXPECT_EQ(distance(states[0].x, states[1].x), 0);
  }
}

/// A jelly beside a face, and the same body whole: with its mirror image, or away from the
/// periodic faces that cut it.
State beside_face(const Method& method, FaceType face, bool whole) {
  SimulationSetup setup =
      make_setup(2, method, dx, {20, 14, 1}, Vector(whole ? -10 * dx : 0, 0, 0));
  setup.volumetric_locking = VolumetricLocking::fbar;
  Random random(73);
  std::vector<Vector> points = lattice(Vector(0, 0.3, 0), Vector(0.35, 0.8, 0), dx / 2, 2);
  for (Vector& x : points) x += random.vector(0.1 * dx / 2, 2);
  const Vector push(face == FaceType::periodic ? 0.7 : -1, 0.5, 0);
  const std::size_t count = points.size();
  if (face == FaceType::periodic) {
    // Begins 0.2 cells before the lower face of the whole domain's middle, or before the upper one.
    const double shift = whole ? -0.17 : -0.17 + 20 * dx;
    for (Vector& x : points) x[0] += shift;
    if (!whole) {
      for (Vector& x : points) x[0] -= x[0] >= 20 * dx ? 20 * dx : 0;
      setup.faces[0] = {FaceType::periodic, FaceType::periodic};
    }
  } else if (!whole) {
    setup.faces[0][0] = face;
  }
  set_velocity(add_jelly(setup, points, dx / 2, {1e5, 0.3, 1000}), push);
  if (whole && face != FaceType::periodic) {
    // The image is of the same body: averages are formed body by body.
    BodySetup& body = setup.bodies[0];
    for (std::size_t p = 0; p < count; ++p) {
      body.position.insert(body.position.end(), {-points[p][0], points[p][1], 0});
      body.velocity.insert(body.velocity.end(), {-push[0], push[1], 0});
      body.velocity_gradient.insert(body.velocity_gradient.end(), 9, 0.0);
    }
  }
  State state = after(std::move(setup), 60, 1e-3);
  state.F.resize(count);
  return state;
}

TEST_P(VolumeAveraging, faces_are_seen_through) {
  if (GetParam().kernel == KernelType::linear)
    return;  // its edge particles blow up sooner or later
  for (FaceType face : {FaceType::symmetry, FaceType::slip, FaceType::periodic}) {
    const State cut = beside_face(GetParam(), face, false);
    const State whole = beside_face(GetParam(), face, true);
    EXPECT_LT(distance(cut.F, whole.F), 1e-9);  // rounding, grown in 60 steps of a stiff body
    double strain = 0;
    for (const Matrix& F : cut.F) strain = std::max(strain, std::abs(F.determinant() - 1));
    EXPECT_TRUE(face == FaceType::periodic || strain > 1e-3) << "the body never felt the face";
  }
}

TEST_P(VolumeAveraging, threads_and_restart_change_no_bit) {
  for (Precision precision : {Precision::double_, Precision::single_}) {
    Method method = GetParam();
    method.precision = precision;
    SimulationSetup setup = random_motion(2, method, VolumetricLocking::fbar);
    setup.faces[0] = {FaceType::periodic, FaceType::periodic};
    set_steps(setup, 12, 2e-4);
    const MemoryArchive end = final_state(setup, 1);
    EXPECT_TRUE(end == final_state(setup, 3));
    const auto first = Simulation::create(setup);
    for (int n = 0; n < 5; ++n) first->step();
    MemoryArchive middle;
    first->save(middle);
    EXPECT_TRUE(end == continued_state(setup, middle));
  }
}

TEST_P(VolumeAveraging, single_precision_follows_double) {
  Method method = GetParam();
  const State exact = after(random_motion(2, method, VolumetricLocking::fbar), 1, 5e-4);
  method.precision = Precision::single_;
  const State single = after(random_motion(2, method, VolumetricLocking::fbar), 1, 5e-4);
  EXPECT_LT(distance(exact.F, single.F), 1e-6);  // a dozen roundings of 6e-8
}

INSTANTIATE_TEST_SUITE_P(methods, VolumeAveraging, ::testing::ValuesIn(split_methods()),
                         [](const auto& info) { return to_string(info.param); });

TEST(VolumeAveragingOfBodies, each_keeps_its_own_change) {
  SimulationSetup setup = make_setup(2, {}, dx, {14, 14, 1});
  setup.volumetric_locking = VolumetricLocking::fbar;
  const auto left = lattice(Vector(0.3, 0.3, 0), Vector(0.7, 0.7, 0), dx / 3, 2);
  const auto right = lattice(Vector(0.7, 0.3, 0), Vector(1.1, 0.7, 0), dx / 3, 2);
  Matrix swell = Matrix::Zero();
  swell(0, 0) = swell(1, 1) = 1;
  set_velocity(add_jelly(setup, left, dx / 3, {}, "left"), Vector::Zero(), swell,
               Vector(0.7, 0.5, 0));
  add_jelly(setup, right, dx / 3, {}, "right");
  const State state = after(std::move(setup), 1, 1e-3);
  double most = 0, total = 0, largest = 0;
  for (std::size_t p = 0; p < state.F.size(); ++p) {
    const double change = state.F[p].determinant() - 1;
    if (p < left.size()) {
      total += change;
    } else if (right[p - left.size()][0] > 0.7 + 3 * dx) {
      most = std::max(most, std::abs(change));
    }
    largest = std::max(largest, std::abs(change));
  }
  EXPECT_GT(total / double(left.size()), 0.8 * 2e-3);  // dt div v, less where both share nodes
  EXPECT_LT(most, 1e-15);                              // beyond the reach of both kernels: rounding
  EXPECT_LT(largest, 1.5 * 2e-3);
}

TEST(VolumeAveragingSetup, the_fused_path_and_coupling_are_refused) {
  SimulationSetup setup = random_motion(2, {}, VolumetricLocking::fbar);
  set_steps(setup, 1, 1e-4);
  EXPECT_FALSE(Simulation::create(setup)->fused());
  setup.path = PathType::fused;
  EXPECT_THROW(Simulation::create(setup), UserError);
}

/// Regular particles, two a direction, in two blocks one after the other along the last axis; the
/// change of volume of each is `change`, linear along that axis.
template <class Kernel, int D, class T>
struct Lattice : BlockScene<D, T> {
  using Scene = BlockScene<D, T>;
  static constexpr int side = 8;
  static constexpr int per_block = power(side, D);

  Lattice() : Scene(Kernel::lattices, {per_block, per_block}, 5) {
    for (const auto& block : this->store.blocks()) {
      for (int i = 0; i < block.count; ++i) {
        const std::int64_t s = slot(block, i);
        for (int a = 0, rest = i; a < D; ++a, rest /= side) {
          this->store.value(s, a) = T(0.5 + 0.5 * (rest % side));
        }
        for (int k = 0; k < D * D; ++k) this->store.aux_value(s, this->layout.increment + k) = T(0);
        this->store.aux_value(s, this->layout.increment) = T(change(place(block, s)));
        this->store.aux_value(s, ratio()) = T(1);
      }
    }
  }

  template <class Block>
  static std::int64_t slot(const Block& block, int i) {
    return std::int64_t(block.batches[std::size_t(i / Scene::width)]) * Scene::width +
           i % Scene::width;
  }
  template <class Block>
  std::array<double, D> place(const Block& block, std::int64_t s) {
    std::array<double, D> x{};
    const BlockCoord<D> c = block_coord<D>(block.key);
    for (int a = 0; a < D; ++a) x[std::size_t(a)] = 4.0 * c[a] + double(this->store.value(s, a));
    return x;
  }
  int ratio() const { return this->layout.external; }
  static double change(const std::array<double, D>& x) { return 1e-3 * (1 - 0.2 * x[D - 1]); }
};

/// Both bodies on a group, which may be the strict one.
template <class Kernel, class Group, int D, class T>
void average(Lattice<Kernel, D, T>& scene, int gradient = -1) {
  const VolumeFields fields{scene.ratio(), scene.ratio() + 1, gradient};
  PassData<D, T> data = scene.data();
  for (int c = 0; c < 2; ++c) data.read[c] = scene.write[c].data();
  scene.template run<Group>(data,
                            [&](Group& g) { scatter_volumes_block<Kernel>(g, data, fields); });
  ThreadPool pool(1);
  for (auto& channel : scene.write) {
    form_node_means(scene.grid, FacePairs<D>{}, channel, pool);
  }
  scene.template run<Group>(data, [&](Group& g) { gather_volumes_block<Kernel>(g, data, fields); });
}

template <class Kernel, int D, class T>
void expect_linear_field_kept() {
  Lattice<Kernel, D, T> scene, strict;
  average<Kernel, CpuGroup<D, T, Kernel>>(scene);
  average<Kernel, StrictGroup<D, T, Kernel>>(strict);  // throws at a missing barrier
  double interior = 0, edge = 0, groups = 0;
  for (const auto& block : scene.store.blocks()) {
    for (int i = 0; i < block.count; ++i) {
      const std::int64_t s = scene.slot(block, i);
      const auto x = scene.place(block, s);
      const double ratio = double(scene.store.aux_value(s, scene.ratio()));
      const double off = std::abs(ratio - 1 - scene.change(x));
      const bool inside = std::abs(x[D - 1] - 4.25) < 1.2;  // three cells from either end
      inside ? interior = std::max(interior, off) : edge = std::max(edge, off);
      groups = std::max(groups, std::abs(ratio - double(strict.store.aux_value(s, scene.ratio()))));
    }
  }
  // The ratio 1 + change rounds.
  EXPECT_LT(interior, 4 * double(std::numeric_limits<T>::epsilon()));
  EXPECT_LT(groups, 4 * double(std::numeric_limits<T>::epsilon()));
  EXPECT_GT(edge, 1e-6);
}

TEST(VolumeAveragingPasses, linear_fields_stay_in_the_interior_of_a_lattice) {
  expect_linear_field_kept<Compact, 2, double>();
  expect_linear_field_kept<Compact, 3, double>();
  expect_linear_field_kept<Quadratic, 2, double>();
  expect_linear_field_kept<Compact, 2, float>();
}

/// Particles under pressure or apart (J_e) that dilate each by its own amount, and did so before.
/// Returns the largest difference between the change that they are given and their own.
double given_less_own(double elastic_ratio) {
  Lattice<Compact, 2, double> scene;
  const double J = 1.05;
  Random random(91);
  std::vector<double> wanted;
  for (const auto& block : scene.store.blocks()) {
    for (int i = 0; i < block.count; ++i) {
      const std::int64_t s = scene.slot(block, i);
      const double own = random.uniform(-1e-3, 1e-3);
      for (int k = 0; k < 9; ++k) scene.store.value(s, 2 + k) = k % 4 == 0 ? 1 : 0;
      scene.store.value(s, 2) = elastic_ratio;
      scene.store.aux_value(s, scene.layout.increment) = own;
      scene.store.aux_value(s, scene.ratio()) = J;
      scene.store.aux_value(s, scene.ratio() + 1) = std::log(J / elastic_ratio) - own;
      wanted.push_back(J * (1 + own));
    }
  }
  average<Compact, CpuGroup<2, double, Compact>>(scene, 2);
  double most = 0;
  std::size_t next = 0;
  for (const auto& block : scene.store.blocks()) {
    for (int i = 0; i < block.count; ++i) {
      const double ratio = scene.store.aux_value(scene.slot(block, i), scene.ratio());
      most = std::max(most, std::abs(ratio - wanted[next++]));
    }
  }
  return most;
}

TEST(VolumeAveragingPasses, plastic_changes_of_volume_stay_with_their_particles) {
  EXPECT_LT(given_less_own(0.98), 20 * epsilon);  // two logarithms and their difference
  EXPECT_GT(given_less_own(1.001), 3e-4);         // grains out of contact get the mean
}

}  // namespace
}  // namespace scree::testing
