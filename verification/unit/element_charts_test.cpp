// SPDX-License-Identifier: Apache-2.0
// The diagrams of `scree element`: signs, limits, and what is left out.
#include "app/element_charts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/support/example_decks.hpp"

namespace scree {
namespace {

/// The diagrams of a deck of inputs/element; none where this build lacks the law.
std::vector<Chart> charts_of(const std::string& name,
                             const std::vector<std::string>& overrides = {}) {
  const auto deck = testing::element_example(name, overrides);
  return deck ? element_charts(*deck, drive_element(*deck)) : std::vector<Chart>{};
}

#define SKIP_WITHOUT_LAW(charts)                            \
  if ((charts).empty() && !::testing::Test::HasFailure()) { \
    GTEST_SKIP() << "this build has no such law";           \
  }                                                         \
  ASSERT_GE((charts).size(), 2u)

const Curve& path_of(const Chart& chart) { return chart.curves.back(); }

bool has(const std::vector<Chart>& charts, const std::string& y_label) {
  return std::any_of(charts.begin(), charts.end(),
                     [&](const Chart& chart) { return chart.y_label == y_label; });
}

/// A limit q = slope p + q0, within what a point misses that counts as yielding before it does:
/// 1e-7 of the law's scale of stress.
void expect_line(const Curve& limit, double slope, double q0, double tolerance) {
  ASSERT_GT(limit.x.size(), 20u);
  for (std::size_t i = 0; i < limit.x.size(); ++i) {
    EXPECT_NEAR(limit.y[i], slope * limit.x[i] + q0, tolerance) << limit.x[i];
  }
}

const double sin_phi = 0.5, cot_phi = std::sqrt(3);
const double compression = 6 * sin_phi / (3 - sin_phi), extension = 6 * sin_phi / (3 + sin_phi);

TEST(ElementCharts, ExtensionIsDrawnBelowTheAxisAgainstItsOwnLimit) {
  const auto charts =
      charts_of("mohr_coulomb_triaxial_drained", {"path.strain=-0.03", "material.soil.cohesion=0"});
  SKIP_WITHOUT_LAW(charts);
  ASSERT_EQ(charts[1].curves.size(), 2u);
  expect_line(charts[1].curves[0], -extension, 0, 0.01);
  const Curve& path = path_of(charts[1]);
  // At failure sigma_1 = sigma_3/Kp = 100/3 kPa.
  EXPECT_NEAR(path.y.back(), -100 * (1 - 1.0 / 3), 1e-5);
  EXPECT_NEAR(path.y.back(), -extension * path.x.back(), 1e-5);
  EXPECT_NEAR(path_of(charts[0]).y.back(), path.y.back(), 1e-12);
}

TEST(ElementCharts, APathThatGoesBothWaysHasBothLimits) {
  const auto charts =
      charts_of("mohr_coulomb_triaxial_drained", {"path.strain=0.02", "path.unload=-0.02"});
  SKIP_WITHOUT_LAW(charts);
  ASSERT_EQ(charts[1].curves.size(), 3u);
  // c cot phi carries the Kirchhoff stress: up to 2 % of volume change do not matter in 5 kPa.
  expect_line(charts[1].curves[0], compression, compression * 5 * cot_phi, 0.3);
  expect_line(charts[1].curves[1], -extension, -extension * 5 * cot_phi, 0.3);
  EXPECT_EQ(charts[1].curves[0].name, "yield at the end");
  EXPECT_EQ(charts[1].curves[1].name, "");
}

TEST(ElementCharts, ShearHasTheLimitAtItsLodeAngle) {
  const auto charts = charts_of("mohr_coulomb_plane_strain", {"material.soil.cohesion=0"});
  SKIP_WITHOUT_LAW(charts);
  // sigma_1 - sigma_2 = 2 p sin phi with sigma_3 = p: q = sqrt(3) p sin phi.
  expect_line(charts[1].curves[0], std::sqrt(3) * sin_phi, 0, 0.05);
}

TEST(ElementCharts, FastFlowIsDrawnAgainstTheLimitOfSlowFlow) {
  const auto charts = charts_of("mu_i_simple_shear");
  SKIP_WITHOUT_LAW(charts);
  EXPECT_EQ(charts[1].curves[0].name, "slow flow");
  ASSERT_EQ(charts[1].x_label, "Pressure p (Pa)");
  // The scale of stress is the shear modulus, 3.8 MPa.
  expect_line(charts[1].curves[0], std::sqrt(3) * 0.38, 0, 1);
  const auto slow = charts_of("mu_i_simple_shear", {"path.duration=\"1e6 s\""});
  EXPECT_EQ(slow[1].curves[0].name, "yield at the end");
}

TEST(ElementCharts, RoundingIsNoPressure) {
  const auto charts = charts_of("von_mises_simple_shear");
  SKIP_WITHOUT_LAW(charts);
  for (const double p : path_of(charts[1]).x) EXPECT_EQ(p, 0);
  // The law's stress is Kirchhoff's: p/K of it, 25 kPa over 66.7 MPa, beside Cauchy's.
  expect_line(charts[1].curves[0], 0, 100, 100 * 25e3 / 66.6e6 + 0.01);
  EXPECT_LT(charts[1].curves[0].x.front(), -10);
  EXPECT_GT(charts[1].curves[0].x.back(), 10);
  EXPECT_FALSE(has(charts, "Stress ratio q/p"));
  EXPECT_FALSE(has(charts, "Volumetric strain (%)"));
  const auto elastic = charts_of("hencky_cycle");
  for (const double p : path_of(elastic[1]).x) EXPECT_EQ(p, 0);
  EXPECT_EQ(elastic.size(), 2u);
}

TEST(ElementCharts, IsotropicTestsAreDrawnOverTheirVolumetricStrain) {
  const auto charts = charts_of("nacc_isotropic");
  SKIP_WITHOUT_LAW(charts);
  EXPECT_EQ(charts[0].x_label, "Volumetric strain (%)");
  EXPECT_NEAR(path_of(charts[0]).x.back(), 10, 1e-12);
  EXPECT_FALSE(has(charts, "Volumetric strain (%)"));
}

TEST(ElementCharts, AConstantVoidRatioHasNoDiagram) {
  const auto undrained = charts_of("modified_cam_clay_triaxial_undrained");
  SKIP_WITHOUT_LAW(undrained);
  EXPECT_FALSE(has(undrained, "Void ratio"));
  EXPECT_TRUE(has(undrained, "Stress ratio q/p"));
  EXPECT_TRUE(has(undrained, "Excess pore pressure (kPa)"));
  EXPECT_TRUE(has(charts_of("modified_cam_clay_isotropic"), "Void ratio"));
}

}  // namespace
}  // namespace scree
