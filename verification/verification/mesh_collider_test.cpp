// SPDX-License-Identifier: Apache-2.0
//
// Bodies on triangulated and rastered ground.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/reference/closed_forms.hpp"
#include "verification/support/meshes.hpp"
#include "verification/support/scene.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.025, theta = std::numbers::pi / 6;

ColliderSpec floor_with(const ShapeSpec& shape, double friction) {
  ColliderSpec spec;
  spec.name = "floor";
  spec.shape = shape;
  spec.contact = {ContactType::friction, friction};
  return spec;
}

/// A block of 0.1 m on a floor at z = 0.04, gravity turned as on an incline of 30 degrees.
std::vector<HistoryRow> slide_on(const ShapeSpec& shape) {
  Method method;
  SimulationSetup setup = make_setup(3, method, dx, {20, 8, 10});
  setup.gravity = [](double) {
    return std::array<double, 3>{9.81 * std::sin(theta), 0, -9.81 * std::cos(theta)};
  };
  setup.colliders.push_back(floor_with(shape, 0.3));
  const auto points = lattice(Vector(0.05, 0.05, 0.04), Vector(0.15, 0.15, 0.14), dx / 2, 3);
  add_jelly(setup, points, dx / 2, {1e5, 0.3, 1000});
  setup.schedule = Schedule(0.2, 0.05, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  return run_with_history(*simulation, schedule);
}

// The triangles' normals are exact, those from edges and corners rounded: both runs do the same
// arithmetic but for 1e-16 in normals, which some 200 steps carry on.
TEST(MeshCollider, ATriangulatedPlaneIsAPlane) {
  const TemporaryFolder folder;
  // Seven squares, so that edges lie between the nodes, reaching beyond the domain.
  write_text(folder / "floor.obj", obj_text(sheet_mesh({-0.2, -0.2}, {0.7, 0.5}, 0.04, 7)));
  ShapeSpec mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.file = (folder / "floor.obj").string();
  mesh.extrude = {0, 0, -0.3};
  ShapeSpec plane;
  plane.kind = ShapeKind::plane;
  plane.point = {0, 0, 0.04};
  plane.normal = {0, 0, 1};
  const auto a = slide_on(mesh), b = slide_on(plane);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(b.back().center[0] - b.front().center[0], 0.03);  // a t^2/2 = 0.047 less the fall
  const double weight = 9.81 * b.front().mass;
  for (std::size_t i = 1; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(a[i].center[c], b[i].center[c], 1e-12) << "rounding";
      EXPECT_NEAR(a[i].collider_force_torque[0][std::size_t(c)],
                  b[i].collider_force_torque[0][std::size_t(c)], 1e-9 * weight)
          << "rounding of impulses over the step";
    }
  }
}

/// Mean way along an incline of 30 degrees in 2D, given as a raster of one row, at both times.
double slide_down_raster(double friction, double settle) {
  const TemporaryFolder folder;
  std::string text = "ncols 8\nnrows 1\nxllcenter -0.1\nyllcenter 0\ncellsize 0.3\n";
  const double slope = std::tan(theta);
  for (int i = 0; i < 8; ++i) text += std::to_string(1.0 - slope * (0.3 * i - 0.1)) + " ";
  write_text(folder / "hill.asc", text);
  ShapeSpec hill;
  hill.kind = ShapeKind::heightmap;
  hill.file = (folder / "hill.asc").string();
  hill.base = -0.5;
  SimulationSetup setup = make_setup(2, Method{}, dx, {72, 56, 1});
  setup.gravity = [settle](double t) {
    return std::array<double, 3>{0, -9.81 * (settle > 0 ? std::min(t / settle, 1.0) : 1.0), 0};
  };
  if (settle > 0) setup.damping = DampingType::mass, setup.damping_value = 100;
  setup.colliders.push_back(floor_with(hill, friction));
  // The block stands on the slope: turned, with its lower left corner at x = 0.1 on the surface.
  const double c = std::cos(theta), s = std::sin(theta);
  std::vector<Vector> points;
  for (const Vector& p : lattice(Vector(0, 0, 0), Vector(0.2, 0.1, 0), dx / 3, 2))
    points.push_back({0.2 + c * p.x() + s * p.y(), 1 - slope * 0.2 - s * p.x() + c * p.y(), 0});
  add_jelly(setup, points, dx / 3, {1e6, 0.3, 1000});
  setup.schedule = Schedule(0.6, 0.3, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const auto rows = run_with_history(*simulation, schedule);
  const auto way = [&](std::size_t i) {
    return c * (rows.at(i).center[0] - rows[0].center[0]) -
           s * (rows.at(i).center[1] - rows[0].center[1]);
  };
  return settle > 0 ? way(2) - way(1) : way(2);
}

// Coulomb's law holds node by node with the exact normal, so it holds for the block. It first falls
// onto the grid's nodes, by less than a cell, during which nothing rubs: at most
// mu g cos(theta) t sqrt(2 dx/(g cos(theta))) more in all, 0.12 m of 0.85; most of that is not
// there, since contact begins where the particles' nodes are.
TEST(HeightmapCollider, ABlockSlidesAsCoulombSays) {
  const double exact = reference::SlidingBlock(theta, 0.3).displacement(0.6);
  EXPECT_NEAR(slide_down_raster(0.3, 0) / exact, 1, 0.02);
}

TEST(HeightmapCollider, ABlockStaysBelowTheFrictionAngle) {
  EXPECT_LT(std::abs(slide_down_raster(0.7, 0.2)), 0.02 * dx);  // tan 30 deg = 0.577
}

// A body thrown at a wall two cells thick with half a cell a step: nodes within a cell inside hold
// every particle that has reached them, so none gets deeper than that.
TEST(MeshCollider, NothingPassesThroughAWallOfTwoCells) {
  const TemporaryFolder folder;
  write_text(folder / "wall.obj", obj_text(sheet_mesh({-1, -1}, {2, 2}, 0, 5)));
  ShapeSpec wall;
  wall.kind = ShapeKind::mesh;
  wall.file = (folder / "wall.obj").string();
  wall.rotate = RotationSpec{{0, 1, 0}, std::numbers::pi / 2};  // z up -> x
  wall.translate = {0.31, 0, 0};                                // not on nodes
  wall.extrude = {2 * dx, 0, 0};
  Method method;
  SimulationSetup setup = make_setup(3, method, dx, {24, 8, 8});
  setup.cfl = 0.5;
  ColliderSpec spec = floor_with(wall, 0);
  spec.contact = {ContactType::slip, 0};
  setup.colliders.push_back(spec);
  const auto points = lattice(Vector(0.1, 0.05, 0.05), Vector(0.2, 0.15, 0.15), dx / 3, 3);
  BodySetup& body = add_jelly(setup, points, dx / 3, {1e4, 0.3, 1000});
  set_velocity(body, Vector(6, 0, 0));  // twice the speed of sound
  setup.schedule = Schedule(0.05, 0.05, 0, 0);
  const auto simulation = Simulation::create(std::move(setup));
  double deepest = 0;
  while (simulation->time() < 0.05) simulation->step();
  for (const Vector& x : state_of(*simulation).x) deepest = std::max(deepest, x.x());
  EXPECT_LT(deepest, 0.31 + dx);
  EXPECT_GT(deepest, 0.31 - 2 * dx);  // it did get there
}

}  // namespace
}  // namespace scree::testing
