// SPDX-License-Identifier: Apache-2.0
// Surfaces of shapes for viewers: their areas and volumes are those of the shapes.
#include "postproc/colliders/shape_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

using Point = SurfaceMesh::Point;
constexpr double pi = std::numbers::pi;
const Box unit_domain{{0, 0, 0}, {1, 1, 1}};

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Twice the vector area of a polygon.
Point vector_area(const SurfaceMesh& mesh, const SurfaceMesh::Cell& cell) {
  Point sum{};
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Point part = cross(mesh.points[std::size_t(cell[i])],
                             mesh.points[std::size_t(cell[(i + 1) % cell.size()])]);
    for (std::size_t a = 0; a < 3; ++a) sum[a] += part[a];
  }
  return sum;
}

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& cell : mesh.polygons) {
    const Point n = vector_area(mesh, cell);
    sum += 0.5 * std::hypot(n[0], n[1], n[2]);
  }
  return sum;
}

double length(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& line : mesh.lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Point &a = mesh.points[std::size_t(line[i])],
                  &b = mesh.points[std::size_t(line[i + 1])];
      sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
  }
  return sum;
}

ShapeSpec box_spec(const Point& lower, const Point& upper) {
  ShapeSpec spec;
  spec.kind = ShapeKind::box;
  spec.lower = lower;
  spec.upper = upper;
  return spec;
}

ShapeSpec sphere_spec(const Point& center, double radius) {
  ShapeSpec spec;
  spec.kind = ShapeKind::sphere;
  spec.center = center;
  spec.radius = radius;
  return spec;
}

// Area of a polygon of 96 sides over that of its circle: 1 - 7e-4; of a sphere 1 - 1e-3.
constexpr double round = 2e-3;

TEST(ShapeSurface, FlatShapesHaveTheirAreaAndOutline) {
  const SurfaceMesh box = shape_surface(box_spec({0, 0, 0}, {0.5, 0.2, 0}), 2, unit_domain);
  EXPECT_NEAR(area(box), 0.5 * 0.2, 1e-15);
  EXPECT_NEAR(length(box), 2 * (0.5 + 0.2), 1e-15);
  const SurfaceMesh disk = shape_surface(sphere_spec({0.5, 0.5, 0}, 0.2), 2, unit_domain);
  EXPECT_NEAR(area(disk), pi * 0.04, round * pi * 0.04);
  ShapeSpec strip;
  strip.kind = ShapeKind::cylinder;
  strip.from = {0.1, 0.1, 0};
  strip.to = {0.4, 0.5, 0};
  strip.radius = 0.05;
  EXPECT_NEAR(area(shape_surface(strip, 2, unit_domain)), 0.5 * 0.1, 1e-15);  // 3-4-5
  ShapeSpec half;
  half.kind = ShapeKind::plane;
  half.point = {0.5, 0.5, 0};
  half.normal = {1, 1, 0};
  EXPECT_NEAR(area(shape_surface(half, 2, unit_domain)), 0.5, 1e-15);
}

TEST(ShapeSurface, SolidsHaveTheirArea) {
  const Point size{0.5, 0.3, 0.2};
  EXPECT_NEAR(area(shape_surface(box_spec({0, 0, 0}, size), 3, unit_domain)),
              2 * (0.5 * 0.3 + 0.3 * 0.2 + 0.2 * 0.5), 1e-15);
  EXPECT_NEAR(area(shape_surface(sphere_spec({0.5, 0.5, 0.5}, 0.3), 3, unit_domain)), 4 * pi * 0.09,
              round * 4 * pi * 0.09);
  ShapeSpec pipe;
  pipe.kind = ShapeKind::cylinder;
  pipe.from = {0.2, 0.2, 0.2};
  pipe.to = {0.5, 0.6, 0.2};
  pipe.radius = 0.1;
  const double expected = 2 * pi * 0.01 + 2 * pi * 0.1 * 0.5;
  EXPECT_NEAR(area(shape_surface(pipe, 3, unit_domain)), expected, round * expected);
  ShapeSpec diagonal;
  diagonal.kind = ShapeKind::plane;
  diagonal.point = {0.5, 0.5, 0.5};
  diagonal.normal = {1, -1, 0};
  EXPECT_NEAR(area(shape_surface(diagonal, 3, unit_domain)), std::sqrt(2.0), 1e-14);
}

TEST(ShapeSurface, CombinationsFollowTheirParts) {
  ShapeSpec plate;
  plate.kind = ShapeKind::difference;
  plate.of = {box_spec({0.1, 0.1, 0}, {0.9, 0.7, 0}), sphere_spec({0.5, 0.4, 0}, 0.2)};
  const SurfaceMesh flat = shape_surface(plate, 2, unit_domain);
  // Cells of 1e-3: corners are cut by half a cell, the circle by less.
  EXPECT_NEAR(area(flat), 0.8 * 0.6 - pi * 0.04, 1e-5);
  EXPECT_NEAR(length(flat), 2 * (0.8 + 0.6) + 2 * pi * 0.2, 5e-3);
  ShapeSpec solid;
  solid.kind = ShapeKind::intersection;
  solid.of = {box_spec({0, 0, 0}, {1, 1, 0.5}), sphere_spec({0.5, 0.5, 0.5}, 0.3)};
  const SurfaceMesh half_ball = shape_surface(solid, 3, unit_domain);
  const double expected = 3 * pi * 0.09;
  EXPECT_NEAR(area(half_ball), expected, 0.01 * expected);  // the rim is cut by a cell of 6e-3
}

TEST(ShapeSurface, ATerrainIsDrawnFromRimToRim) {
  const TemporaryFolder folder;
  write_text(folder / "slope.asc",
             "ncols 4\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n"
             "1 2 3 4\n1 2 3 4\n");
  ShapeSpec spec;
  spec.kind = ShapeKind::heightmap;
  spec.file = (folder / "slope.asc").string();
  spec.base = -1;
  const SurfaceMesh mesh = shape_surface(spec, 3, {{0, 0, 0}, {40, 20, 10}});
  // Slope 1 in 10 between the outermost centres, level to the rims.
  EXPECT_NEAR(area(mesh), 20 * (30 * std::hypot(1.0, 0.1) + 10), 1e-9);
}

}  // namespace
}  // namespace scree
