// SPDX-License-Identifier: Apache-2.0
//
// The state of a law that carries a given stress.
#include "materials/initial_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/drucker_prager.hpp"
#include "materials/fixed_corotated.hpp"
#include "materials/j_fluid.hpp"
#include "materials/mu_i.hpp"
#include "materials/registry.hpp"
#include "materials/typical_input.hpp"

namespace scree {
namespace {

using Stress = std::array<double, 3>;

constexpr double young = 2e7, poisson = 0.3;

DruckerPrager::Input sand(double cohesion = 0) {
  DruckerPrager::Input in;
  in.youngs_modulus = young;
  in.poissons_ratio = poisson;
  in.friction_angle = std::numbers::pi / 6;
  in.cohesion = cohesion;
  return in;
}

struct Case {
  std::string model;
  std::any input;
  std::unique_ptr<MaterialPoint> point() const {
    return make_material_point(model, input, 1800, 3);
  }
  std::optional<std::vector<double>> state(const Stress& stress) const {
    return initial_state(*point(), find_material_model(model)->fields, stress);
  }
};
const Case jelly{"fixed_corotated", FixedCorotated::Input{young, poisson}};
const Case fluid{"j_fluid", JFluid::Input{1e6, 7, 1e-3, 1}};
Case sand_case(double cohesion = 0) { return {"drucker_prager", sand(cohesion)}; }

void expect_carries(const Case& law, const Stress& stress) {
  const auto state = law.state(stress);
  ASSERT_TRUE(state.has_value()) << law.model;
  const auto point = law.point();
  point->set_entries(*state);
  const Sym3<double> tau = point->stress();
  // What initial_state promises; the rounding of a stretch near 1 is 1.1e-16, times the stiffness.
  const double most = std::max({std::abs(stress[0]), std::abs(stress[1]), std::abs(stress[2])});
  const double tolerance = std::max(1e-12 * most, 1e-15 * 2 * young);
  EXPECT_NEAR(tau.xx, stress[0], tolerance) << law.model;
  EXPECT_NEAR(tau.yy, stress[1], tolerance) << law.model;
  EXPECT_NEAR(tau.zz, stress[2], tolerance) << law.model;
  EXPECT_NEAR(tau.xy, 0, tolerance) << law.model;
}

TEST(InitialState, CarriesCompressionAtAnyDepth) {
  for (const double depth : {1e-6, 1e-3, 1.0, 100.0}) {
    const double vertical = -18e3 * depth;
    const Stress rest{0.5 * vertical, vertical, 0.5 * vertical};
    expect_carries(jelly, rest);
    expect_carries(sand_case(), rest);
  }
}

TEST(InitialState, NothingHasYieldedAndVolumeCountsFromThere) {
  const Stress rest{-5e4, -1e5, -6e4};
  const auto entries = *sand_case().state(rest);
  EXPECT_EQ(entries[9], 0);   // volume correction
  EXPECT_EQ(entries[10], 0);  // plastic strain
  EXPECT_EQ(entries[11], 0);  // total ln J
  const auto point = sand_case().point();
  point->set_entries(entries);
  EXPECT_EQ(point->volume_ratio(), 1);  // so Cauchy and Kirchhoff stress are the same
}

TEST(InitialState, ZeroStressIsTheUndeformedState) {
  for (const Case& law : {jelly, sand_case(), fluid}) {
    EXPECT_EQ(law.state({0, 0, 0}), law.point()->entries()) << law.model;
  }
}

TEST(InitialState, TensionOnlyWhereTheLawHoldsIt) {
  EXPECT_FALSE(sand_case().state({10, 10, 10}));
  expect_carries(sand_case(1e4), {10, 10, 10});
  expect_carries(jelly, {1e4, -2e4, 3e3});
}

/// In triaxial compression the outer cone is that of Mohr and Coulomb: K_a = (1 - sin)/(1 + sin).
TEST(InitialState, YieldSurfaceIsTheLimit) {
  const double active = (1 - std::sin(std::numbers::pi / 6)) / (1 + std::sin(std::numbers::pi / 6));
  const auto at = [](double k) { return sand_case().state({-1e5 * k, -1e5, -1e5 * k}); };
  EXPECT_TRUE(at(active * 1.0001));
  EXPECT_FALSE(at(active * 0.9999));
}

TEST(InitialState, FluidsCarryPressureOnly) {
  expect_carries(fluid, {-3e4, -3e4, -3e4});
  EXPECT_FALSE(fluid.state({-3e4, -3.001e4, -3e4}));
}

TEST(InitialState, RatioAtRestComesFromTheModel) {
  const auto ratio = [](const Case& law) {
    return find_material_model(law.model)->rest_ratio(law.input);
  };
  EXPECT_NEAR(ratio(jelly), poisson / (1 - poisson), 1e-15);
  EXPECT_NEAR(ratio(sand_case()), 1 - 0.5, 1e-15);
  EXPECT_EQ(ratio(fluid), 1);
}

/// Grains yield in one-dimensional compression unless nu is large: 3 (1 - K0)/(1 + 2 K0) = q/p =
/// sqrt(3) mu_s.
TEST(InitialState, RatioAtRestOfGrainsIsWithinTheirFriction) {
  MuI::Input in{1e7, 0.3, 0.38, 0.64, 0.279, 1e-3, 2500};
  const auto ratio = [&] { return find_material_model("mu_i")->rest_ratio(in); };
  EXPECT_NEAR(3 * (1 - ratio()) / (1 + 2 * ratio()), std::sqrt(3) * 0.38, 1e-14);
  in.poissons_ratio = 0.45;
  EXPECT_NEAR(ratio(), 0.45 / 0.55, 1e-15);
}

/// The ground that a deck gets without k0.
TEST(InitialState, EveryLawCarriesItsOwnRatioAtRest) {
  for (const MaterialEntry& entry : material_registry()) {
    for (const int dimension : {2, 3}) {
      const std::any input = typical_input(entry, dimension);
      const double k0 = entry.rest_ratio(input);
      for (const double vertical : {-100.0, -1e3, -2e4}) {
        const Stress stress{k0 * vertical, vertical, k0 * vertical};
        const auto point = make_material_point(entry.name, input, 1800, dimension);
        const auto state = entry.state_under ? entry.state_under(input, stress)
                                             : initial_state(*point, entry.fields, stress);
        ASSERT_TRUE(state.has_value()) << entry.name << " " << dimension << "D " << vertical;
        point->set_entries(*state);
        // As expect_carries; the stiffest of the typical inputs has 2e7 Pa.
        EXPECT_NEAR(point->stress().xx, stress[0], std::max(-1e-12 * vertical, 1e-15 * 4e7));
        EXPECT_NEAR(point->stress().yy, stress[1], std::max(-1e-12 * vertical, 1e-15 * 4e7));
      }
    }
  }
}

}  // namespace
}  // namespace scree
