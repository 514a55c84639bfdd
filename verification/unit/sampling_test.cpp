// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "solver/base/error.hpp"

namespace scree {
namespace {

using Point = std::array<double, 3>;
constexpr double pi = std::numbers::pi;

ShapeSpec box(const Point& lower, const Point& upper) {
  ShapeSpec s;
  s.lower = lower;
  s.upper = upper;
  return s;
}

ShapeSpec sphere(const Point& center, double radius) {
  ShapeSpec s;
  s.kind = ShapeKind::sphere;
  s.center = center;
  s.radius = radius;
  return s;
}

ShapeSpec polygon(std::vector<std::array<double, 2>> points) {
  ShapeSpec s;
  s.kind = ShapeKind::polygon;
  s.points = std::move(points);
  s.z = {0, 1, 0};
  return s;
}

SampledBody fill(const ShapeSpec& spec, const Point& lower, double cell, int per_direction,
                 int dimension) {
  return sample(*make_shape(spec, dimension), lower, cell, per_direction, dimension);
}

TEST(Sampling, BoxOfWholeSpacingsHasExactlyItsCount) {
  // Cell sizes and corners that are no binary fractions; the box begins `shift` spacings off the
  // lattice: 0 is aligned, 0.5 puts its faces on the centres of sites.
  for (double cell : {0.1, 0.005, 1.0 / 3, 0.7})
    for (int per_direction : {1, 2, 3, 5})
      for (double shift : {0.0, 0.25, 0.5, 0.8})
        for (double origin : {0.0, -0.3, 1234.1}) {
          const double s = cell / per_direction;
          const Point lower{origin, origin / 3, -origin};
          Point a, b;
          const int n[3] = {7, 12, 5};
          for (int i = 0; i < 3; ++i) {
            a[i] = lower[i] + (11 + shift) * s;
            b[i] = lower[i] + (11 + shift + n[i]) * s;
          }
          EXPECT_EQ(fill(box(a, b), lower, cell, per_direction, 2).count(), n[0] * n[1])
              << cell << ' ' << per_direction << ' ' << shift << ' ' << origin;
          EXPECT_EQ(fill(box(a, b), lower, cell, per_direction, 3).count(), n[0] * n[1] * n[2])
              << cell << ' ' << per_direction << ' ' << shift << ' ' << origin;
        }
}

TEST(Sampling, ParticlesOfABoxAreTheCentresOfItsSubcells) {
  const double s = 0.1 / 3;
  const SampledBody body = fill(box({0.2, 0.1, 0}, {0.4, 0.2, 0}), {0, 0, 0}, 0.1, 3, 2);
  ASSERT_EQ(body.count(), 6 * 3);
  for (int p = 0; p < 18; ++p) {
    EXPECT_NEAR(body.position[3 * p + 0], 0.2 + (p % 6 + 0.5) * s, 1e-15);
    EXPECT_NEAR(body.position[3 * p + 1], 0.1 + (p / 6 + 0.5) * s, 1e-15);
    EXPECT_EQ(body.position[3 * p + 2], 0);
    const auto site = body.lattice.site(&body.position[3 * p]);
    EXPECT_EQ(site[0], 6 + p % 6);
    EXPECT_EQ(site[1], 3 + p / 6);
  }
  EXPECT_DOUBLE_EQ(body.spacing, s);
  EXPECT_DOUBLE_EQ(body.particle_volume, s * s);
}

TEST(Sampling, BodiesThatShareASurfaceShareNoParticle) {
  // A square cut along a diagonal that runs through sites.
  const SampledBody one = fill(polygon({{0, 0}, {1, 0}, {1, 1}}), {0, 0, 0}, 0.1, 2, 2);
  const SampledBody two = fill(polygon({{0, 0}, {1, 1}, {0, 1}}), {0, 0, 0}, 0.1, 2, 2);
  EXPECT_EQ(one.count() + two.count(), 20 * 20);
  std::set<std::pair<double, double>> all;
  for (const SampledBody* body : {&one, &two})
    for (std::int64_t p = 0; p < body->count(); ++p)
      all.insert({body->position[3 * p], body->position[3 * p + 1]});
  EXPECT_EQ(all.size(), 400u);
}

TEST(Sampling, UnionCountsCommonParticlesOnce) {
  ShapeSpec both;
  both.kind = ShapeKind::union_of;
  both.of = {box({0, 0, 0}, {1, 0.5, 1}), box({0, 0.25, 0}, {1, 1, 1})};
  EXPECT_EQ(fill(both, {0, 0, 0}, 0.25, 2, 3).count(), 8 * 8 * 8);
  both.kind = ShapeKind::difference;
  EXPECT_EQ(fill(both, {0, 0, 0}, 0.25, 2, 3).count(), 8 * 2 * 8);
  both.kind = ShapeKind::intersection;
  EXPECT_EQ(fill(both, {0, 0, 0}, 0.25, 2, 3).count(), 8 * 2 * 8);
}

/// Root mean square of the volume error over random places of the shape.
template <class Make>
double volume_error(Make make, double volume, double spacing, int dimension) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, spacing);
  const int trials = 60;
  double sum = 0;
  for (int i = 0; i < trials; ++i) {
    const Point shift{uniform(random), uniform(random), uniform(random)};
    const SampledBody body = fill(make(shift), {0, 0, 0}, spacing, 1, dimension);
    const double error = static_cast<double>(body.count()) * body.particle_volume - volume;
    sum += error * error;
  }
  return std::sqrt(sum / trials);
}

// Lattice points in a randomly placed convex body with smooth boundary: the standard deviation of
// the volume is O(h^((d+1)/2)) (Kendall, Quart. J. Math. 19, 1948): order 1.5 in 2D, 2 in 3D. The
// band is three standard errors of an rms over 60 trials (9 % each) over a factor 4 or 8 in h.
TEST(Sampling, VolumeOfADiskConvergesWithOrderThreeHalves) {
  const auto disk = [](const Point& c) { return sphere(c, 1); };
  const double coarse = volume_error(disk, pi, 0.1, 2), fine = volume_error(disk, pi, 0.0125, 2);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(8.0), 1.5, 0.2);
  // Kendall's constant for the circle: variance of the count 0.6765 R / h.
  EXPECT_NEAR(fine / std::sqrt(0.6765 / 0.0125) / (0.0125 * 0.0125), 1, 0.3);
}

TEST(Sampling, VolumeOfASphereConvergesWithOrderTwo) {
  const auto ball = [](const Point& c) { return sphere(c, 1); };
  const double coarse = volume_error(ball, 4 * pi / 3, 0.2, 3);
  const double fine = volume_error(ball, 4 * pi / 3, 0.05, 3);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2, 0.3);
}

// A cylinder along an axis of the lattice, of whole spacings: the disk's error times its height.
TEST(Sampling, VolumeOfACylinderConvergesWithOrderThreeHalves) {
  const auto can = [](const Point& c) {
    ShapeSpec s;
    s.kind = ShapeKind::cylinder;
    s.from = {c[0], c[1], 0};
    s.to = {c[0], c[1], 0.4};
    s.radius = 1;
    return s;
  };
  const double coarse = volume_error(can, 0.4 * pi, 0.1, 3);
  const double fine = volume_error(can, 0.4 * pi, 0.025, 3);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 1.5, 0.3);
}

// Straight sides of irrational slope are met far more evenly than a random h^1.5; that the error
// stays below a tenth of a layer (perimeter x h) separates a right sampling from one that gains or
// loses half a layer, and it must fall faster than the first order.
TEST(Sampling, VolumeOfAPolygonConvergesFasterThanALayer) {
  const auto triangle = [](const Point& c) {
    return polygon({{c[0], c[1]}, {c[0] + 1.1, c[1] + 0.37}, {c[0] + 0.29, c[1] + 1.3}});
  };
  const double area = 0.5 * (1.1 * 1.3 - 0.37 * 0.29);
  const double perimeter = std::hypot(1.1, 0.37) + std::hypot(0.81, 0.93) + std::hypot(0.29, 1.3);
  const double coarse = volume_error(triangle, area, 0.1, 2);
  const double fine = volume_error(triangle, area, 0.0125, 2);
  EXPECT_LT(coarse, 0.1 * perimeter * 0.1);
  EXPECT_GT(std::log(coarse / fine) / std::log(8.0), 1.2);
}

TEST(Sampling, ImpossibleBodiesAreRefused) {
  ShapeSpec half;
  half.kind = ShapeKind::plane;
  half.normal = {0, 1, 0};
  EXPECT_THROW(fill(half, {0, 0, 0}, 0.1, 2, 2), UserError);
  EXPECT_THROW(fill(box({0, 0, 0}, {1e9, 1e9, 1e9}), {0, 0, 0}, 0.1, 2, 3), UserError);
}

TEST(Sampling, AShapeBetweenTheSitesIsEmpty) {
  EXPECT_EQ(fill(sphere({0.1, 0.1, 0}, 0.01), {0, 0, 0}, 0.1, 1, 2).count(), 0);
}

}  // namespace
}  // namespace scree
