// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree {
namespace {

using Point = std::array<double, 3>;
constexpr double rounding = 1e-13;  // a sum of up to 1e3 faces of total area up to 6

ShapeSpec box(const Point& lower, const Point& upper) {
  ShapeSpec s;
  s.lower = lower;
  s.upper = upper;
  return s;
}

SampledBody brick() {
  return sample(*make_shape(box({0, 0, 0}, {1, 2, 0.5}), 3), {0, 0, 0}, 0.25, 2, 3);
}

struct Sum {
  double vector[3] = {0, 0, 0};
  double area = 0;
};

Sum total(const SurfacePatch& patch) {
  Sum sum;
  for (std::size_t i = 0; i < patch.particle.size(); ++i) {
    for (int a = 0; a < 3; ++a) sum.vector[a] += patch.area_vector[3 * i + a];
    sum.area += patch.area[i];
  }
  return sum;
}

TEST(Surface, AClosedSurfaceHasNoNetArea) {
  const SurfacePatch patch = exposed_faces(brick(), {});
  const Sum sum = total(patch);
  for (double v : sum.vector) EXPECT_NEAR(v, 0, rounding);
  EXPECT_EQ(patch.count(), 8 * 16 * 4 - 6 * 14 * 2);  // all but the inner particles
}

TEST(Surface, AThinRegionOnASideSelectsExactlyThatSide) {
  const auto region = make_shape(box({-1, 1.95, -1}, {2, 2.05, 1}), 3);
  SurfaceSelection selection;
  selection.region = region.get();
  const SurfacePatch patch = exposed_faces(brick(), selection);
  const Sum sum = total(patch);
  EXPECT_EQ(patch.count(), 8 * 4);
  EXPECT_NEAR(sum.vector[0], 0, rounding);
  EXPECT_NEAR(sum.vector[1], 1 * 0.5, rounding);
  EXPECT_NEAR(sum.vector[2], 0, rounding);
  EXPECT_NEAR(sum.area, 1 * 0.5, rounding);
}

TEST(Surface, TheRimOfTheRegionBelongsToIt) {
  for (const ShapeSpec& spec : {box({0, 2, 0}, {1, 3, 0.5}), box({0, 1.94, 0}, {1, 2, 0.5})}) {
    const auto region = make_shape(spec, 3);
    SurfaceSelection selection;
    selection.region = region.get();
    EXPECT_NEAR(total(exposed_faces(brick(), selection)).vector[1], 0.5, rounding);
  }
}

TEST(Surface, FacingPicksOneSideOfAThickRegion) {
  const auto region = make_shape(box({-1, 1.5, -1}, {2, 2.5, 1}), 3);
  SurfaceSelection selection;
  selection.region = region.get();
  EXPECT_GT(total(exposed_faces(brick(), selection)).area, 0.6);  // reaches round the corners
  selection.facing = {0, 3, 0};
  const Sum sum = total(exposed_faces(brick(), selection));
  EXPECT_NEAR(sum.vector[1], 0.5, rounding);
  EXPECT_NEAR(sum.area, 0.5, rounding);
}

TEST(Surface, WallsCoverTheFacesThatLieOnThem) {
  SurfaceSelection selection;
  selection.wall[0] = {true, true};
  selection.wall[1] = {true, false};
  selection.wall[2] = {true, true};
  selection.domain_upper = {1, 4, 0.5};
  const Sum sum = total(exposed_faces(brick(), selection));
  EXPECT_NEAR(sum.vector[0], 0, rounding);
  EXPECT_NEAR(sum.vector[1], 0.5, rounding);
  EXPECT_NEAR(sum.area, 0.5, rounding);  // the top alone
}

TEST(Surface, CornersAndThinBodies) {
  // One particle in 2D: four faces; the vectors cancel, the area is sqrt(2^2 + 2^2) s.
  const SampledBody one =
      sample(*make_shape(box({0, 0, 0}, {0.1, 0.1, 0}), 2), {0, 0, 0}, 0.1, 1, 2);
  const SurfacePatch patch = exposed_faces(one, {});
  ASSERT_EQ(patch.count(), 1);
  EXPECT_EQ(patch.area_vector[0], 0);
  EXPECT_EQ(patch.area_vector[1], 0);
  EXPECT_DOUBLE_EQ(patch.area[0], 0.1 * std::sqrt(8.0));
  // The corner of a 2 x 2 block: (s, s).
  const SampledBody four =
      sample(*make_shape(box({0, 0, 0}, {0.2, 0.2, 0}), 2), {0, 0, 0}, 0.1, 1, 2);
  const SurfacePatch corners = exposed_faces(four, {});
  ASSERT_EQ(corners.count(), 4);
  EXPECT_DOUBLE_EQ(corners.area_vector[0], -0.1);
  EXPECT_DOUBLE_EQ(corners.area_vector[1], -0.1);
  EXPECT_DOUBLE_EQ(corners.area[0], 0.1 * std::sqrt(2.0));
}

// The staircase of a ball projects to a disk: its area is that of the sampled midplane.
TEST(Surface, ProjectedAreaOfABallIsItsDisk) {
  ShapeSpec spec;
  spec.kind = ShapeKind::sphere;
  spec.center = {1, 1, 1};
  spec.radius = 0.8;
  const SampledBody ball = sample(*make_shape(spec, 3), {0, 0, 0}, 0.05, 1, 3);
  SurfaceSelection selection;
  selection.facing = {0, 0, 1};
  const Sum up = total(exposed_faces(ball, selection));
  // The lattice disk errs by less than one ring of half a spacing.
  EXPECT_NEAR(up.vector[2], std::numbers::pi * 0.64, 2 * std::numbers::pi * 0.8 * 0.025);
  const Sum all = total(exposed_faces(ball, {}));
  for (double v : all.vector) EXPECT_NEAR(v, 0, rounding);
}

}  // namespace
}  // namespace scree
