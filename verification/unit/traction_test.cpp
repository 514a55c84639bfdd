// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/traction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/error.hpp"
#include "solver/particles/surface.hpp"

namespace scree {
namespace {

constexpr double rounding = 1e-12;  // relative to forces of about 1e3 after scaling

TractionSpec pressure(const std::string& text) {
  TractionSpec spec;
  spec.name = "load";
  spec.pressure.text = text;
  return spec;
}

TractionSpec value(const std::string& x, const std::string& y, const std::string& z) {
  TractionSpec spec;
  spec.name = "load";
  spec.value[0].text = x;
  spec.value[1].text = y;
  spec.value[2].text = z;
  return spec;
}

/// A brick of 1 x 2 x 0.5 m, 1/8 m between particles.
SampledBody brick() {
  ShapeSpec spec;
  spec.upper = {1, 2, 0.5};
  return sample(*make_shape(spec, 3), {0, 0, 0}, 0.25, 2, 3);
}

Vec3<double> vector_at(const std::vector<double>& v, std::size_t i) {
  return {{v[3 * i], v[3 * i + 1], v[3 * i + 2]}};
}

/// Sum of the forces on a patch, all particles with the same F.
Vec3<double> resultant(const Traction& traction, const SampledBody& body, const SurfacePatch& patch,
                       const Mat3<double>& F, double t = 0) {
  Vec3<double> sum{};
  for (std::size_t i = 0; i < patch.particle.size(); ++i) {
    const Vec3<double> x = vector_at(body.position, static_cast<std::size_t>(patch.particle[i]));
    sum = sum + traction.force(t, x, x, vector_at(patch.area_vector, i), patch.area[i], F);
  }
  return sum;
}

const Mat3<double> squeezed{{{1.1, 0.2, 0}, {-0.1, 0.8, 0.05}, {0.3, 0, 1.2}}};

SurfacePatch side(const SampledBody& body, const std::array<double, 3>& facing) {
  SurfaceSelection selection;
  selection.facing = facing;
  return exposed_faces(body, selection);
}

TEST(Traction, UniformPressureOnAClosedSurfaceHasNoResultant) {
  const SampledBody body = brick();
  const Traction traction(pressure("1e3"), 3);
  const Vec3<double> f = resultant(traction, body, exposed_faces(body, {}), squeezed);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(f[a], 0, 1e3 * rounding);
}

TEST(Traction, PressureOnASideIsPressureTimesArea) {
  const SampledBody body = brick();
  const Traction traction(pressure("1e3*t"), 3);
  EXPECT_TRUE(traction.follows_surface());
  const Vec3<double> f = resultant(traction, body, side(body, {0, 1, 0}), identity3<double>(), 2);
  EXPECT_NEAR(f[0], 0, rounding);
  EXPECT_NEAR(f[1], -2e3 * (1 * 0.5), 1e3 * rounding);
  EXPECT_NEAR(f[2], 0, rounding);
}

// Stretches (a, b, c) make the x side b c times as large; a turn carries the force along.
TEST(Traction, PressureFollowsTheSurface) {
  const SampledBody body = brick();
  const Traction traction(pressure("1e3"), 3);
  Mat3<double> F = identity3<double>();
  F(0, 0) = 3;
  F(1, 1) = 0.5;
  F(2, 2) = 1.25;
  const SurfacePatch right = side(body, {1, 0, 0});
  EXPECT_NEAR(resultant(traction, body, right, F)[0], -1e3 * (2 * 0.5) * (0.5 * 1.25),
              1e3 * rounding);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Mat3<double> turn{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  const Vec3<double> f = resultant(traction, body, right, turn);
  EXPECT_NEAR(f[0], -1e3 * c, 1e3 * rounding);
  EXPECT_NEAR(f[1], -1e3 * s, 1e3 * rounding);
}

// p = g (2 - y), read at the particles, half a spacing inside: between the top and bottom rows
// lies 2 - h, so the lift is g times the base times (2 - h), h = 1/8.
TEST(Traction, HydrostaticPressureLifts) {
  const SampledBody body = brick();
  const Traction traction(pressure("100*(2-y)"), 3);
  const Vec3<double> f = resultant(traction, body, exposed_faces(body, {}), identity3<double>());
  EXPECT_NEAR(f[0], 0, 1e3 * rounding);
  EXPECT_NEAR(f[1], 100 * (1 * 0.5) * (2 - 0.125), 1e3 * rounding);
  EXPECT_NEAR(f[2], 0, 1e3 * rounding);
}

TEST(Traction, AValueIsADeadLoad) {
  const SampledBody body = brick();
  const Traction traction(value("10", "-1e3*t", "X+2*Y"), 3);
  EXPECT_FALSE(traction.follows_surface());
  const SurfacePatch top = side(body, {0, 1, 0});
  const Vec3<double> f = resultant(traction, body, top, squeezed, 0.5);
  EXPECT_NEAR(f[0], 10 * 0.5, 1e3 * rounding);
  EXPECT_NEAR(f[1], -500 * 0.5, 1e3 * rounding);
  // Mean of X over the top row is 1/2; Y = 2 - 1/16.
  EXPECT_NEAR(f[2], (0.5 + 2 * (2 - 0.0625)) * 0.5, 1e3 * rounding);
}

TEST(Traction, PresentAndInitialPositionsAreKeptApart) {
  const Traction traction(value("x", "X", "0"), 3);
  const Vec3<double> f = traction.force(0, {{5, 0, 0}}, {{7, 0, 0}}, {{0, 1, 0}}, 2, squeezed);
  EXPECT_EQ(f[0], 10);
  EXPECT_EQ(f[1], 14);
}

TEST(Traction, In2DForcesAreByMetreOfThickness) {
  ShapeSpec spec;
  spec.upper = {1, 2, 0};
  const SampledBody body = sample(*make_shape(spec, 2), {0, 0, 0}, 0.25, 2, 2);
  const Traction traction(pressure("1e3"), 2);
  const Vec3<double> f = resultant(traction, body, side(body, {0, 1, 0}), identity3<double>());
  EXPECT_NEAR(f[1], -1e3, 1e3 * rounding);
  const Traction dead(value("1", "2", ""), 2);
  EXPECT_NEAR(resultant(dead, body, side(body, {0, 1, 0}), identity3<double>())[1], 2, rounding);
}

TEST(Traction, ALoadThatIsNoNumberStopsTheRun) {
  const Traction traction(pressure("1/(t-1)"), 2);
  EXPECT_THROW(traction.force(1, {}, {}, {{0, 1, 0}}, 1, identity3<double>()), RunFault);
}

}  // namespace
}  // namespace scree
