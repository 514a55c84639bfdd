// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/mesh_solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "solver/geometry/predicates.hpp"
#include "verification/support/meshes.hpp"

namespace scree {
namespace {

using testing::box_mesh;
using testing::icosphere;
using testing::joined;
using testing::sheet_mesh;
using testing::torus_mesh;
using Point = TriangleMesh::Point;

constexpr double pi = std::numbers::pi;

std::string fault_of(const TriangleMesh& mesh, const Point& extrusion = {}) {
  try {
    const MeshSolid solid(mesh, extrusion);
  } catch (const GeometryFault& fault) {
    return fault.key() + " " + fault.what();
  }
  return "none";
}

bool begins(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

TEST(Predicates, SmallestSteps) {
  const double a[2] = {0.1, 0.1}, b[2] = {0.3, 0.3}, on[2] = {0.2, 0.2};
  const double above[2] = {0.2, std::nextafter(0.2, 1)};
  EXPECT_EQ(orientation(a, b, on), 0);
  EXPECT_EQ(orientation(a, b, above), 1);
  EXPECT_EQ(orientation(b, a, above), -1);
  EXPECT_NE(perturbed_orientation(a, b, on), 0);
  EXPECT_EQ(perturbed_orientation(a, b, on), -perturbed_orientation(b, a, on));
}

TEST(MeshSolid, BoxIsExact) {
  const MeshSolid box(box_mesh({0.1, -1, 2}, {0.6, 1, 2.25}));
  EXPECT_NEAR(box.volume(), 0.5 * 2 * 0.25, 1e-15);  // rounding
  EXPECT_EQ(box.turned(), 0);
  const double above[3] = {0.3, 0.2, 2.35}, corner[3] = {0.7, 1.1, 2.35}, deep[3] = {0.3, 0, 2.05};
  EXPECT_NEAR(box.signed_distance(above), 0.1, 1e-15);
  EXPECT_NEAR(box.signed_distance(corner), std::sqrt(0.03), 1e-15);
  EXPECT_NEAR(box.signed_distance(deep), -0.05, 1e-15);
  double n[3];
  box.normal(above, n);
  EXPECT_EQ((Point{n[0], n[1], n[2]}), (Point{0, 0, 1}));
  box.normal(deep, n);
  EXPECT_EQ((Point{n[0], n[1], n[2]}), (Point{0, 0, -1}));
  box.normal(corner, n);
  for (const double c : n) EXPECT_NEAR(c, 1 / std::sqrt(3.0), 1e-14);
  const double at_corner[3] = {0.6, 1, 2.25};
  box.normal(at_corner, n);  // three faces with right angles
  for (const double c : n) EXPECT_NEAR(c, 1 / std::sqrt(3.0), 1e-15);
}

// The inscribed polyhedron lacks (radius/edge)^-2 of the volume: order 2 in the edge length.
TEST(MeshSolid, SphereConvergesWithTheSquareOfTheEdge) {
  const double exact = 4 * pi / 3 * 8;
  double before = 0;
  for (int level = 2; level <= 4; ++level) {
    const double error = exact - MeshSolid(icosphere(2, level)).volume();
    EXPECT_GT(error, 0);
    // The next term is smaller by the square of the edge, 0.3 at level 2.
    const double ratio = level > 2 ? before / error : 4;
    EXPECT_NEAR(ratio, 4, 0.1);
    before = error;
  }
}

TEST(MeshSolid, DirectionOfTheTrianglesDoesNotMatter) {
  TriangleMesh some = icosphere(1, 2), all = some;
  for (auto& t : all.triangles) std::swap(t[0], t[1]);
  std::swap(some.triangles[7][0], some.triangles[7][2]);
  const MeshSolid right(icosphere(1, 2)), one(some), inverted(all);
  EXPECT_EQ(one.turned(), 1);
  EXPECT_EQ(inverted.turned(), std::int64_t(all.triangles.size()));
  EXPECT_EQ(one.volume(), right.volume());
  EXPECT_NEAR(inverted.volume(), right.volume(), 1e-14);  // corners in another order: rounding
}

TEST(MeshSolid, ASurfaceInsideAnotherBoundsACavity) {
  const MeshSolid hollow(joined(box_mesh({0, 0, 0}, {3, 3, 3}), box_mesh({1, 1, 1}, {2, 2, 2})));
  EXPECT_NEAR(hollow.volume(), 26, 1e-13);
  const double wall[3] = {0.5, 1.5, 1.5}, middle[3] = {1.5, 1.5, 1.5}, near[3] = {1.1, 1.5, 1.4};
  EXPECT_TRUE(hollow.inside(wall));
  EXPECT_FALSE(hollow.inside(middle));
  double n[3];
  hollow.normal(near, n);
  EXPECT_EQ(n[0], 1);  // out of the solid is into the cavity
}

template <class Distance>
void compare_inside(const MeshSolid& solid, double extent, double margin, Distance distance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-extent, extent);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const double x[3] = {uniform(random), uniform(random), uniform(random)};
    const double d = distance(x);
    if (std::abs(d) < margin) continue;  // between the facets and the smooth surface
    inside += d < 0;
    EXPECT_EQ(solid.inside(x), d < 0) << x[0] << " " << x[1] << " " << x[2];
    EXPECT_NEAR(solid.signed_distance(x), d, margin);
  }
  EXPECT_GT(inside, 300);
}

TEST(MeshSolid, RandomPointsOfASphere) {
  // By how much the deepest facet lies below the sphere on which its corners are.
  const TriangleMesh mesh = icosphere(1, 4);
  double sagitta = 0;
  for (const auto& t : mesh.triangles) {
    double center[3] = {0, 0, 0};
    for (const std::int32_t p : t)
      for (std::size_t a = 0; a < 3; ++a) center[a] += mesh.points[std::size_t(p)][a] / 3;
    sagitta = std::max(sagitta, 1 - std::hypot(center[0], center[1], center[2]));
  }
  EXPECT_LT(sagitta, 2e-3);
  // In triangles that are not equilateral the deepest point lies beside the centroid.
  compare_inside(MeshSolid(mesh), 1.3, 1.1 * sagitta,
                 [](const double* x) { return std::hypot(x[0], x[1], x[2]) - 1; });
}

TEST(MeshSolid, RandomPointsOfATorus) {
  // Sagittas R (1 - cos(pi/n)) of both circles: 1.4 * 5e-4 and 0.4 * 1.2e-3.
  compare_inside(MeshSolid(torus_mesh(1, 0.4, 100, 64)), 1.5, 0.0013, [](const double* x) {
    return std::hypot(std::hypot(x[0], x[1]) - 1, x[2]) - 0.4;
  });
}

// The ray of such a point runs through edges and corners of many triangles.
TEST(MeshSolid, RaysThroughEdgesAndCorners) {
  TriangleMesh block = sheet_mesh({0, 0}, {1, 1}, 1, 8);
  const MeshSolid solid(block, {0, 0, -1});
  EXPECT_NEAR(solid.volume(), 1, 1e-15);
  for (int i = -2; i <= 18; ++i)
    for (int j = -2; j <= 18; ++j)
      for (int k = -2; k <= 18; ++k) {
        const double x[3] = {i / 16.0, j / 16.0, k / 16.0};
        const bool out = i < 0 || i > 16 || j < 0 || j > 16 || k < 0 || k > 16;
        const bool in = i > 0 && i < 16 && j > 0 && j < 16 && k > 0 && k < 16;
        EXPECT_FALSE(out && solid.inside(x)) << i << " " << j << " " << k;
        EXPECT_TRUE(!in || solid.inside(x)) << i << " " << j << " " << k;
      }
}

TEST(MeshSolid, AMillionPointsInSeconds) {
  const MeshSolid solid(icosphere(1, 6));  // 81920 triangles
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto start = std::chrono::steady_clock::now();
  std::int64_t inside = 0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const double x[3] = {uniform(random), uniform(random), uniform(random)};
    inside += solid.inside(x);
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("microseconds_per_point", int(1e6 * seconds / count));
  // Four standard deviations of a binomial count.
  EXPECT_NEAR(double(inside) / count, pi / 6, 4 * std::sqrt(0.25 / count));
}

TEST(MeshSolid, AHoleIsNamedWithItsPlace) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 2, 3});
  mesh.triangles.erase(mesh.triangles.begin());  // corners 0, 2, 3 of the bottom
  EXPECT_TRUE(begins(fault_of(mesh),
                     "file is not closed: 3 edges have a triangle on one side only, the first from "
                     "(0, 0, 0) to (0, 2, 0) m;"))
      << fault_of(mesh);
}

TEST(MeshSolid, WhatIsNoSolid) {
  EXPECT_TRUE(begins(fault_of({}), "file holds no triangle"));
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.points[5][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(begins(fault_of(mesh), "file its point number 6 is not finite: (1, nan, 1)"));
  mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(begins(fault_of(joined(mesh, mesh)), "file encloses nothing: each of its triangles"));
  EXPECT_TRUE(begins(fault_of(box_mesh({0, 0, 0}, {1, 1, 0})), "file encloses nothing"));
  EXPECT_TRUE(begins(fault_of(mesh, {0, 0, 1}), "extrude is for open sheets"));
  EXPECT_EQ(fault_of(sheet_mesh({0, 0}, {1, 1}, 0, 2), {0, 0, -1}), "none");
  EXPECT_TRUE(begins(fault_of(sheet_mesh({0, 0}, {1, 1}, 0, 2), {0.5, 0, 0}), "file "));
}

TEST(MeshSolid, SurfacesThatPassThroughEachOtherAreRefused) {
  const TriangleMesh two =
      joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({.5, .4, .3}, {2, 2, 2}));
  EXPECT_TRUE(begins(fault_of(two), "file passes through itself near (")) << fault_of(two);
  // Here every side of one goes through an edge of the other, the diagonal of a face.
  const TriangleMesh diagonal =
      joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({.5, .5, .5}, {1.5, 1.5, 1.5}));
  EXPECT_TRUE(begins(fault_of(diagonal), "file passes through itself near ("))
      << fault_of(diagonal);
  // Those that only touch, along an edge, a part of it or at a corner, stay.
  for (const double z : {0.0, 0.5, 1.0}) {
    const MeshSolid touching(
        joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({1, 1, z}, {2, 2, z + 1})));
    EXPECT_NEAR(touching.volume(), 2, 1e-15) << z;
  }
  // Those that share a face are one solid: the wall between them goes.
  const MeshSolid row(joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({1, 0, 0}, {2, 1, 1})));
  EXPECT_NEAR(row.volume(), 2, 1e-15);
}

/// Which side of the common area is solid, the triangles there cannot say.
TEST(MeshSolid, SurfacesThatLieOnEachOtherAreRefused) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const auto refused = [&](const TriangleMesh& other) {
    return begins(fault_of(joined(box, other)), "file lies on itself near (1, 0.");
  };
  EXPECT_TRUE(refused(box_mesh({1, 0, 0}, {2, 0.5, 0.5})));  // solids side by side
  EXPECT_TRUE(refused(box_mesh({1, 0.25, 0.25}, {2, 1.25, 0.75})));
  EXPECT_TRUE(refused(box_mesh({0.5, 0.25, 0.25}, {1, 0.75, 0.75})));  // a cavity at the wall
  // Near each other by more than rounding is apart.
  EXPECT_EQ(fault_of(joined(box, box_mesh({1 + 1e-12, 0, 0}, {2, 0.5, 0.5}))), "none");
}

TEST(MeshSolid, TrianglesWithoutAreaDoNoHarm) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles.push_back({3, 3, 1});  // two corners are one
  // A needle between the two triangles of a side: (0, 3, middle of 0 and 3).
  mesh.points.push_back({0.5, 0.5, 0});
  for (auto& t : mesh.triangles)
    if (t == TriangleMesh::Triangle{0, 2, 3}) t = {0, 2, 8};
  mesh.triangles.push_back({8, 2, 3});
  mesh.triangles.push_back({0, 8, 3});
  const MeshSolid solid(mesh);
  EXPECT_NEAR(solid.volume(), 1, 1e-15);
  const double below[3] = {0.5, 0.5, -0.25};
  EXPECT_NEAR(solid.signed_distance(below), 0.25, 1e-15);
  double n[3];
  solid.normal(below, n);
  EXPECT_NEAR(n[2], -1, 1e-15);
}

}  // namespace
}  // namespace scree
