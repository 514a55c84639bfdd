// SPDX-License-Identifier: Apache-2.0
// What every material must do, for every line of materials/list.def.
#include <gtest/gtest.h>

#include "verification/conformance/samples.hpp"

namespace scree {
namespace {

using testing::MatrixSource;

template <class M>
class MaterialTest : public ::testing::Test {
 protected:
  using Input = typename M::Input;
  using Params = typename M::template Params<double>;
  using State = typename M::template State<double>;

  template <class F>
  static void for_each_sample(F check) {
    const auto inputs = testing::sample_inputs<M>();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      SCOPED_TRACE(std::string(M::name) + " sample " + std::to_string(i));
      check(inputs[i], M::template params<double>(inputs[i], testing::density, 3),
            testing::stiffness<M>(inputs[i]));
    }
  }
  static Sym3<double> stress_now(const Params& p, State state) {
    return M::kirchhoff(p, state, zero3<double>(), 0.0);
  }
  /// Stress without the part from the rate of deformation.
  static Sym3<double> stress_at_rest(const Params& p, State state) {
    return M::kirchhoff(p, state, zero3<double>(), 1.0);
  }
  MatrixSource source{21};
};
TYPED_TEST_SUITE(MaterialTest, testing::MaterialTypes);

TYPED_TEST(MaterialTest, FulfilsTheContract) {
  using M = TypeParam;
  static_assert(Material<M>);
  using State = typename M::template State<double>;
  int components = 0;
  for (const StateField& field : M::fields()) {
    EXPECT_FALSE(field.name.empty());
    EXPECT_FALSE(field.unit.empty()) << field.name;
    EXPECT_FALSE(field.doc.empty()) << field.name;
    components += field.components;
  }
  EXPECT_EQ(components * sizeof(double), sizeof(State)) << "fields() does not describe State";
  const MaterialEntry* entry = find_material_model(M::name);
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->schema->name(), M::name);
  EXPECT_EQ(entry->fields.size(), M::fields().size());
  std::any input = entry->make_input();
  EXPECT_EQ(entry->input_pointer(input), &std::any_cast<typename M::Input&>(input));
}

TYPED_TEST(MaterialTest, InitialStateIsAtRestAndAdmissible) {
  using M = TypeParam;
  this->for_each_sample([&](const auto&, const auto& p, double) {
    const auto state = M::template initial<double>(p);
    EXPECT_TRUE(M::admissible(p, state));
    EXPECT_GT(M::volume_ratio(p, state), 0);
    EXPECT_GT(M::wave_speed(p, state), 0);
    const auto stress = this->stress_now(p, state);
    EXPECT_EQ(stress.xx, stress.yy);
    EXPECT_EQ(stress.xy, 0);
  });
}

TYPED_TEST(MaterialTest, ZeroIncrementChangesNothing) {
  using M = TypeParam;
  this->for_each_sample([&](const auto&, const auto& p, double modulus) {
    for (int n = 0; n < 200; ++n) {
      auto state = testing::random_state<M>(p, this->source, 0.03, 4);
      const Mat3<double> L = testing::from_eigen<double>(this->source.entries(0.03));
      const Sym3<double> last = M::kirchhoff(p, state, L, 1e-2);
      auto again = state;
      const Sym3<double> now = M::kirchhoff(p, again, zero3<double>(), 0.0);
      // Rounding of the return map, relative to the modulus.
      EXPECT_LE(testing::distance(last, now), 1e-13 * modulus);
      const auto a = testing::entries<M, double>(state), b = testing::entries<M, double>(again);
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i], b[i], 1e-14 * (1 + std::abs(a[i])));
    }
  });
}

TYPED_TEST(MaterialTest, StressTurnsWithTheFrame) {
  using M = TypeParam;
  this->for_each_sample([&](const auto&, const auto& p, double modulus) {
    for (int n = 0; n < 200; ++n) {
      auto state = testing::random_state<M>(p, this->source, 0.05);
      const Mat3<double> q = testing::from_eigen<double>(this->source.rotation());
      auto turned = testing::rotated<M>(state, q);
      const Mat3<double> L = testing::from_eigen<double>(this->source.entries(0.05));
      const Sym3<double> tau = M::kirchhoff(p, state, L, 1e-2);
      const Sym3<double> tau_turned = M::kirchhoff(p, turned, q * L * transpose(q), 1e-2);
      const Sym3<double> expected = sym(q * to_mat(tau) * transpose(q));
      EXPECT_LE(testing::distance(tau_turned, expected), 1e-12 * modulus);
      EXPECT_NEAR(M::volume_ratio(p, state), M::volume_ratio(p, turned), 1e-12);
      EXPECT_NEAR(M::energy_density(p, state), M::energy_density(p, turned), 1e-12 * modulus);
      EXPECT_NEAR(M::wave_speed(p, state) / M::wave_speed(p, turned), 1, 1e-12);
    }
  });
}

TYPED_TEST(MaterialTest, ElasticStressIsTheDerivativeOfTheEnergy) {
  using M = TypeParam;
  const double h =
      1e-5;  // central difference: truncation h^2, rounding 1e-16 / h relative to the energy
  this->for_each_sample([&](const auto&, const auto& p, double modulus) {
    for (int n = 0; n < 100; ++n) {
      const auto state = testing::elastic_state<M>(p, this->source, 0.05, 0.005);
      const Eigen::Matrix3d direction = this->source.entries(1);
      const auto energy = [&](double step) {
        auto moved = state;
        M::kirchhoff(p, moved, testing::from_eigen<double>(step * direction), 1.0);
        return M::energy_density(p, moved);
      };
      const double power = (testing::to_eigen(this->stress_at_rest(p, state)) * direction).trace();
      EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), power, 1e-8 * modulus);
    }
  });
}

TYPED_TEST(MaterialTest, VolumeRatioFollowsTheDeformation) {
  using M = TypeParam;
  this->for_each_sample([&](const auto&, const auto& p, double) {
    auto state = M::template initial<double>(p);
    double expected = M::volume_ratio(p, state);
    for (int n = 0; n < 200; ++n) {
      const Eigen::Matrix3d L = this->source.entries(0.02);
      M::kirchhoff(p, state, testing::from_eigen<double>(L), 1e-2);
      // This fluid integrates the rate of J, J <- J (1 + tr L); the others keep J = det F.
      const bool rate = std::is_same_v<M, JFluid>;
      expected *= rate ? 1 + L.trace() : (Eigen::Matrix3d::Identity() + L).determinant();
      EXPECT_NEAR(M::volume_ratio(p, state) / expected, 1, 1e-12);
    }
  });
}

TYPED_TEST(MaterialTest, SmallStrainLimitIsLinearElasticity) {
  using M = TypeParam;
  this->for_each_sample([&](const auto& input, const auto& p, double modulus) {
    double lambda = 0, mu = 0;
    if constexpr (requires { input.youngs_modulus; }) {
      const LameConstants c = lame_constants(input.youngs_modulus, input.poissons_ratio);
      lambda = c.lambda;
      mu = c.mu;
    } else if constexpr (std::is_same_v<M, JFluid>) {
      lambda = input.bulk_modulus * input.gamma;
      if (input.initial_j != 1) return;  // not at small strain
    } else {
      GTEST_SKIP() << "no linear limit is known for this law";
    }
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d L = -one + 0.1 * this->source.entries(1);  // inside every cone
    const auto error = [&](double size) {
      auto state = M::template initial<double>(p);
      M::kirchhoff(p, state, testing::from_eigen<double>(size * L), 1.0);
      const Eigen::Matrix3d strain = size * 0.5 * (L + L.transpose());
      const Eigen::Matrix3d linear = 2 * mu * strain + lambda * strain.trace() * one;
      return (testing::to_eigen(this->stress_at_rest(p, state)) - linear).norm();
    };
    EXPECT_LE(error(1e-4), 100 * 1e-8 * modulus);
    EXPECT_NEAR(error(1e-4) / error(5e-5), 4, 0.1) << "the error must be of second order";
  });
}

}  // namespace
}  // namespace scree
