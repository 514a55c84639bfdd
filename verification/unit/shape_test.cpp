// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "solver/base/error.hpp"

namespace scree {
namespace {

// A few roundings of coordinates of magnitude up to 3.
constexpr double rounding = 1e-14;

ShapeSpec box(std::array<double, 3> lower, std::array<double, 3> upper) {
  ShapeSpec s;
  s.kind = ShapeKind::box;
  s.lower = lower;
  s.upper = upper;
  return s;
}

ShapeSpec sphere(std::array<double, 3> center, double radius) {
  ShapeSpec s;
  s.kind = ShapeKind::sphere;
  s.center = center;
  s.radius = radius;
  return s;
}

ShapeSpec cylinder(std::array<double, 3> from, std::array<double, 3> to, double radius) {
  ShapeSpec s;
  s.kind = ShapeKind::cylinder;
  s.from = from;
  s.to = to;
  s.radius = radius;
  return s;
}

ShapeSpec polygon(std::vector<std::array<double, 2>> points, double z0 = 0, double z1 = 1) {
  ShapeSpec s;
  s.kind = ShapeKind::polygon;
  s.points = std::move(points);
  s.z = {z0, z1, 0};
  return s;
}

ShapeSpec plane(std::array<double, 3> point, std::array<double, 3> normal) {
  ShapeSpec s;
  s.kind = ShapeKind::plane;
  s.point = point;
  s.normal = normal;
  return s;
}

ShapeSpec combine(ShapeKind kind, std::vector<ShapeSpec> of) {
  ShapeSpec s;
  s.kind = kind;
  s.of = std::move(of);
  return s;
}

// An L, clockwise: concave, so that a reentrant corner is tested.
const std::vector<std::array<double, 2>> ell{{0, 0}, {0, 2}, {1, 2}, {1, 1}, {2, 1}, {2, 0}};

double norm(const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// A primitive with an independent formula for "inside".
struct Case {
  std::string name;
  int dimension;
  ShapeSpec spec;
  std::function<bool(const double*)> inside;
};

bool between(double a, double x, double b) { return a < x && x < b; }

bool in_ell(const double* x) {
  return (between(0, x[0], 1) && between(0, x[1], 2)) ||
         (between(0, x[0], 2) && between(0, x[1], 1));
}

/// Inside a cylinder by the cross product with its axis, from (0.2, -0.3, 0.1) to (1.1, 0.8, 1.4).
bool in_tilted(const double* x, int dimension) {
  const double from[3] = {0.2, -0.3, dimension == 3 ? 0.1 : 0};
  const double e[3] = {0.9, 1.1, dimension == 3 ? 1.3 : 0};
  const double r[3] = {x[0] - from[0], x[1] - from[1], dimension == 3 ? x[2] - from[2] : 0};
  const double along = (r[0] * e[0] + r[1] * e[1] + r[2] * e[2]) / norm(e);
  const double cross[3] = {r[1] * e[2] - r[2] * e[1], r[2] * e[0] - r[0] * e[2],
                           r[0] * e[1] - r[1] * e[0]};
  return between(0, along, norm(e)) && norm(cross) / norm(e) < 0.5;
}

std::vector<Case> primitives() {
  return {
      {"box 3D", 3, box({0.1, -0.5, 0.2}, {1.3, 0.4, 1.0}),
       [](const double* x) {
         return between(0.1, x[0], 1.3) && between(-0.5, x[1], 0.4) && between(0.2, x[2], 1.0);
       }},
      {"box 2D", 2, box({0.1, -0.5, 0}, {1.3, 0.4, 0}),
       [](const double* x) { return between(0.1, x[0], 1.3) && between(-0.5, x[1], 0.4); }},
      {"sphere", 3, sphere({0.3, 0.2, 0.1}, 0.9),
       [](const double* x) { return std::hypot(x[0] - 0.3, x[1] - 0.2, x[2] - 0.1) < 0.9; }},
      {"disk", 2, sphere({0.3, 0.2, 0}, 0.9),
       [](const double* x) { return std::hypot(x[0] - 0.3, x[1] - 0.2) < 0.9; }},
      {"cylinder", 3, cylinder({0.2, -0.3, 0.1}, {1.1, 0.8, 1.4}, 0.5),
       [](const double* x) { return in_tilted(x, 3); }},
      {"strip", 2, cylinder({0.2, -0.3, 0}, {1.1, 0.8, 0}, 0.5),
       [](const double* x) { return in_tilted(x, 2); }},
      {"polygon", 2, polygon(ell), in_ell},
      {"prism", 3, polygon(ell, -0.5, 0.75),
       [](const double* x) { return in_ell(x) && between(-0.5, x[2], 0.75); }},
      {"plane", 3, plane({0.5, 0, 0.2}, {2, 2, 1}),
       [](const double* x) { return 2 * (x[0] - 0.5) + 2 * x[1] + (x[2] - 0.2) < 0; }},
  };
}

class Primitives : public testing::Test {
 protected:
  void for_each_point(const std::function<void(const Case&, const Shape&, const double*)>& test) {
    for (const Case& c : primitives()) {
      SCOPED_TRACE(c.name);
      const auto shape = make_shape(c.spec, c.dimension);
      std::mt19937 random(7);
      std::uniform_real_distribution<double> uniform(-1, 2.5);
      for (int i = 0; i < 2000; ++i) {
        const double x[3] = {uniform(random), uniform(random), uniform(random)};
        test(c, *shape, x);
      }
    }
  }
};

TEST_F(Primitives, SignIsThatOfAnIndependentInsideTest) {
  for_each_point([](const Case& c, const Shape& shape, const double* x) {
    if (std::abs(shape.signed_distance(x)) < rounding) return;
    EXPECT_EQ(shape.inside(x), c.inside(x)) << x[0] << ' ' << x[1] << ' ' << x[2];
  });
}

// The foot x - d n lies on the surface, so |d| is no less than the true distance; and a signed
// distance never changes faster than its argument (next test), so |d| is no more than it: exact.
TEST_F(Primitives, FootOfThePerpendicularLiesOnTheSurface) {
  for_each_point([](const Case&, const Shape& shape, const double* x) {
    const double d = shape.signed_distance(x);
    double n[3], foot[3];
    shape.normal(x, n);
    EXPECT_NEAR(norm(n), 1, rounding);
    for (int a = 0; a < 3; ++a) foot[a] = x[a] - d * n[a];
    EXPECT_NEAR(shape.signed_distance(foot), 0, 4 * rounding);
  });
}

TEST_F(Primitives, DistanceChangesNoFasterThanItsArgument) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for_each_point([&](const Case& c, const Shape& shape, const double* x) {
    double y[3] = {x[0], x[1], x[2]}, step = 0;
    for (int a = 0; a < c.dimension; ++a) {
      const double s = uniform(random);
      y[a] += s;
      step += s * s;
    }
    EXPECT_LE(std::abs(shape.signed_distance(y) - shape.signed_distance(x)),
              std::sqrt(step) + rounding);
  });
}

TEST_F(Primitives, InsidePointsLieInTheBounds) {
  for_each_point([](const Case& c, const Shape& shape, const double* x) {
    if (!c.inside(x)) return;
    const Box box = shape.bounds();
    for (int a = 0; a < c.dimension; ++a) {
      EXPECT_GE(x[a], box.lower[a]);
      EXPECT_LE(x[a], box.upper[a]);
    }
  });
}

TEST_F(Primitives, TheThirdCoordinateDoesNotCountIn2D) {
  for_each_point([](const Case& c, const Shape& shape, const double* x) {
    if (c.dimension == 3) return;
    const double flat[3] = {x[0], x[1], 0};
    double n[3];
    shape.normal(x, n);
    EXPECT_EQ(shape.signed_distance(x), shape.signed_distance(flat));
    EXPECT_EQ(n[2], 0);
  });
}

TEST(Shape, KnownDistances) {
  const auto cube = make_shape(box({0, 0, 0}, {1, 1, 1}), 3);
  const double beyond_corner[3] = {2, 3, 3}, in_middle[3] = {0.5, 0.5, 0.6};
  EXPECT_DOUBLE_EQ(cube->signed_distance(beyond_corner), 3);  // (1, 2, 2)
  EXPECT_DOUBLE_EQ(cube->signed_distance(in_middle), -0.4);
  const auto can = make_shape(cylinder({0, 0, 0}, {0, 0, 2}, 1), 3);
  const double beyond_rim[3] = {4, 0, 6};
  EXPECT_DOUBLE_EQ(can->signed_distance(beyond_rim), 5);  // (3, 4)
  const auto corner = make_shape(polygon(ell), 2);
  const double in_notch[3] = {1.25, 1.5, 0}, deep[3] = {0.5, 0.5, 0};
  EXPECT_DOUBLE_EQ(corner->signed_distance(in_notch), 0.25);
  EXPECT_DOUBLE_EQ(corner->signed_distance(deep), -0.5);
}

TEST(Shape, PolygonDoesNotDependOnItsSenseOfRotation) {
  auto turned = ell;
  std::reverse(turned.begin(), turned.end());
  const auto a = make_shape(polygon(ell), 2), b = make_shape(polygon(turned), 2);
  for (double x = -0.55; x < 2.5; x += 0.1)
    for (double y = -0.55; y < 2.5; y += 0.1) {
      const double p[3] = {x, y, 0};
      EXPECT_NEAR(a->signed_distance(p), b->signed_distance(p), rounding);
    }
}

// Places where the gradient of the distance is not unique, and the surface itself.
TEST(Shape, NormalsAreUnitVectorsAtSingularPoints) {
  struct Place {
    ShapeSpec spec;
    int dimension;
    std::array<double, 3> x;
  };
  const std::vector<Place> places{
      {box({0, 0, 0}, {1, 1, 1}), 3, {0.5, 0.5, 0.5}},
      {box({0, 0, 0}, {1, 1, 1}), 3, {1, 1, 1}},
      {box({0, 0, 0}, {1, 1, 1}), 3, {0, 1, 0.5}},
      {box({0, 0, 0}, {1, 1, 0}), 2, {1, 0, 0}},
      {sphere({1, 2, 3}, 1), 3, {1, 2, 3}},
      {sphere({1, 2, 0}, 1), 2, {1, 2, 0}},
      {cylinder({0, 0, 0}, {0, 0, 1}, 2), 3, {0, 0, 0.5}},
      {cylinder({0, 0, 0}, {1, 1, 1}, 0.1), 3, {0.5, 0.5, 0.5}},
      {cylinder({0, 0, 0}, {1, 1, 0}, 0.1), 2, {0.5, 0.5, 0}},
      {cylinder({0, 0, 0}, {0, 0, 1}, 1), 3, {1, 0, 1}},
      {polygon(ell), 2, {0, 0, 0}},
      {polygon(ell), 2, {1, 1, 0}},
      {polygon(ell), 2, {0.5, 1.7, 0}},
      {polygon(ell), 3, {2, 0.5, 1}},
      {polygon(ell), 3, {0, 0, 0}},
  };
  for (const Place& place : places) {
    double n[3];
    make_shape(place.spec, place.dimension)->normal(place.x.data(), n);
    EXPECT_NEAR(norm(n), 1, rounding) << place.x[0] << ' ' << place.x[1] << ' ' << place.x[2];
  }
}

TEST(Shape, NormalsOnFacesPointOut) {
  double n[3];
  const double on_low_face[3] = {0, 0.4, 0.6}, on_edge[3] = {0.5, 0, 0};
  make_shape(box({0, 0, 0}, {1, 1, 1}), 3)->normal(on_low_face, n);
  EXPECT_EQ(n[0], -1);
  make_shape(polygon(ell), 2)->normal(on_edge, n);
  EXPECT_DOUBLE_EQ(n[1], -1);
}

TEST(Shape, CombinationsAreThoseOfTheirParts) {
  const ShapeSpec a = box({0, 0, 0}, {1, 1, 1}), b = sphere({1, 1, 1}, 0.8);
  const ShapeSpec c = cylinder({0, 0.5, 0.5}, {1, 0.5, 0.5}, 0.25);
  const auto sa = make_shape(a, 3), sb = make_shape(b, 3), sc = make_shape(c, 3);
  const auto sum = make_shape(combine(ShapeKind::union_of, {a, b, c}), 3);
  const auto common = make_shape(combine(ShapeKind::intersection, {a, b, c}), 3);
  const auto rest = make_shape(combine(ShapeKind::difference, {a, b, c}), 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.3, 2);
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < 20000; ++i) {
    const double x[3] = {uniform(random), uniform(random), uniform(random)};
    const bool in_a = sa->inside(x), in_b = sb->inside(x), in_c = sc->inside(x);
    EXPECT_EQ(sum->inside(x), in_a || in_b || in_c);
    EXPECT_EQ(common->inside(x), in_a && in_b && in_c);
    EXPECT_EQ(rest->inside(x), in_a && !in_b && !in_c);
    counts[0] += sum->inside(x);
    counts[1] += common->inside(x);
    counts[2] += rest->inside(x);
  }
  for (int count : counts) EXPECT_GT(count, 10);  // every region was hit
}

TEST(Shape, NormalOfADifferencePointsIntoTheHole) {
  const auto tube =
      make_shape(combine(ShapeKind::difference, {sphere({0, 0, 0}, 2), sphere({0, 0, 0}, 1)}), 3);
  const double near_hole[3] = {1.1, 0, 0};
  double n[3];
  tube->normal(near_hole, n);
  EXPECT_NEAR(tube->signed_distance(near_hole), -0.1, rounding);
  EXPECT_DOUBLE_EQ(n[0], -1);
}

TEST(Shape, BoundsOfCombinations) {
  const ShapeSpec a = box({0, 0, 0}, {1, 1, 1}), b = box({0.5, -1, 0.25}, {2, 0.5, 3});
  const Box sum = make_shape(combine(ShapeKind::union_of, {a, b}), 3)->bounds();
  EXPECT_EQ(sum.lower, (std::array<double, 3>{0, -1, 0}));
  EXPECT_EQ(sum.upper, (std::array<double, 3>{2, 1, 3}));
  const ShapeSpec half = plane({0, 0, 0.75}, {0, 0, 1});
  const auto common = make_shape(combine(ShapeKind::intersection, {a, b, half}), 3);
  EXPECT_EQ(common->bounds().lower, (std::array<double, 3>{0.5, 0, 0.25}));
  EXPECT_EQ(common->bounds().upper, (std::array<double, 3>{1, 0.5, 0.75}));
  EXPECT_FALSE(make_shape(half, 3)->bounds().bounded(3));
}

TEST(Shape, BoundsOfATiltedCylinderAreTight) {
  // A disk of radius r whose normal makes 45 degrees with x and y reaches r / sqrt 2 along both.
  const Box b = make_shape(cylinder({0, 0, 0}, {1, 1, 0}, 0.5), 3)->bounds();
  EXPECT_NEAR(b.lower[0], -0.5 / std::sqrt(2.0), rounding);
  EXPECT_NEAR(b.upper[1], 1 + 0.5 / std::sqrt(2.0), rounding);
  EXPECT_NEAR(b.upper[2], 0.5, rounding);
}

TEST(Shape, MistakesAreNamed) {
  const auto key = [](const ShapeSpec& spec, int dimension) {
    const auto problem = find_problem(spec, dimension);
    EXPECT_THROW(make_shape(spec, dimension), UserError);
    return problem ? problem->key : std::string("none");
  };
  EXPECT_EQ(key(box({0, 0, 0}, {1, 0, 1}), 2), "upper");
  EXPECT_EQ(key(sphere({0, 0, 0}, 0), 3), "radius");
  EXPECT_EQ(key(sphere({0, 0, 0}, std::nan("")), 3), "radius");
  EXPECT_EQ(key(cylinder({1, 2, 3}, {1, 2, 4}, 1), 2), "to");
  EXPECT_EQ(key(cylinder({1, 2, 3}, {1, 2, 4}, -1), 3), "radius");
  EXPECT_EQ(key(polygon({{0, 0}, {1, 0}}), 2), "points");
  EXPECT_EQ(key(polygon({{0, 0}, {1, 1}, {3, 3}}), 2), "points");
  EXPECT_EQ(key(polygon({{0, 0}, {1, 1}, {1, 1}, {0, 1}}), 2), "points");
  EXPECT_EQ(key(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1.5}}), 2), "points");  // crosses itself
  EXPECT_EQ(key(polygon(ell, 1, 1), 3), "z");
  EXPECT_EQ(key(plane({0, 0, 0}, {0, 0, 1}), 2), "normal");
  EXPECT_EQ(key(combine(ShapeKind::union_of, {}), 2), "of");
  EXPECT_EQ(key(combine(ShapeKind::union_of, {polygon(ell), sphere({0, 0, 0}, -1)}), 2),
            "of[1].radius");
  EXPECT_FALSE(find_problem(box({0, 0, 0}, {1, 1, 0}), 2));
  EXPECT_FALSE(find_problem(polygon(ell, 1, 1), 2));
}

}  // namespace
}  // namespace scree
