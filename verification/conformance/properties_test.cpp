// SPDX-License-Identifier: Apache-2.0
// What every line of materials/list.def must do. checks.hpp says what is measured, this file what
// is allowed and why; elastic_controls_test.cpp and plastic_controls_test.cpp that each check can
// fail.
#include <gtest/gtest.h>

#include "materials/typical_input.hpp"
#include "verification/conformance/checks.hpp"
#include "verification/support/effort.hpp"

namespace scree::testing {
namespace {

/// The model's name is the parameter; every test runs over all of its sample inputs.
class EveryLaw : public ::testing::TestWithParam<std::string> {
 protected:
  const Family& family() const { return find_family(GetParam()); }
  template <class F>
  void for_each_law(F check) {
    for (const Law& law : family().laws()) {
      SCOPED_TRACE(law.name);
      check(law);
    }
  }
  MatrixSource source{21};
};
INSTANTIATE_TEST_SUITE_P(List, EveryLaw, ::testing::ValuesIn(family_names()),
                         [](const auto& info) { return info.param; });

TEST_P(EveryLaw, DescribesItself) {
  const MaterialEntry* entry = find_material_model(GetParam());
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->schema->name(), GetParam());
  EXPECT_FALSE(entry->schema->doc().empty());
  EXPECT_FALSE(entry->schema->citations().empty()) << "no publication to cite";
  for (const auto& key : entry->schema->entries()) EXPECT_FALSE(key->doc.empty()) << key->key;
  const std::vector<Law> laws = family().laws();
  const Law& law = laws.at(0);
  for (const StateField& field : law.fields) {
    EXPECT_FALSE(field.name.empty());
    EXPECT_FALSE(field.unit.empty()) << field.name;
    EXPECT_FALSE(field.doc.empty()) << field.name;
    EXPECT_TRUE(field.components == 1 || field.components == 3 || field.components == 6 ||
                field.components == 9);
  }
  EXPECT_EQ(entry->fields.size(), law.fields.size());
  std::any input = entry->make_input();
  EXPECT_NE(entry->input_pointer(input), nullptr);
  EXPECT_NO_THROW(typical_input(*entry, 2));
  EXPECT_NO_THROW(typical_input(*entry, 3));
}

TEST_P(EveryLaw, InitialStateIsIsotropicAndAdmissible) {
  for_each_law([](const Law& law) {
    const State state = law.exact->initial();
    EXPECT_TRUE(law.exact->admissible(state));
    EXPECT_GT(law.exact->volume_ratio(state), 0);
    EXPECT_GT(law.exact->wave_speed(state), 0);
    const Sym3<double> stress = stress_at_rest(law, state);
    EXPECT_NEAR(norm(deviator(stress)), 0, 1e-14 * norm(stress));
    EXPECT_LE(law.exact->yield_value(state).value_or(0), 1e-12);
  });
}

// Rounding of the return map; a large compression amplifies it a few times.
TEST_P(EveryLaw, ZeroStrainChangesNothing) {
  for_each_law([this](const Law& law) {
    const Worst worst = change_without_strain(law, source, 500);
    EXPECT_LE(worst.error, 1e-13);
    EXPECT_GT(worst.samples, 800);
  });
}

TEST_P(EveryLaw, IsObjective) {
  for_each_law([this](const Law& law) {
    const Worst worst = loss_of_objectivity(law, source, 500);
    EXPECT_LE(worst.error, 1e-12);
    EXPECT_GT(worst.samples, 1200);
  });
}

TEST_P(EveryLaw, IsIsotropic) {
  for_each_law([this](const Law& law) {
    const Worst worst = loss_of_isotropy(law, source, 500);
    EXPECT_LE(worst.error, 1e-12);
    EXPECT_GT(worst.samples, 1200);
  });
}

TEST_P(EveryLaw, KeepsTheVolumeRatio) {
  for_each_law([this](const Law& law) {
    EXPECT_LE(loss_of_volume(law, source, 200).error, 1e-12);  // 200 roundings of 1e-16
  });
}

// Central difference with h = 1e-5: truncation h^2 times third derivatives of order 1 to 10,
// rounding 1e-16/h relative to the energy.
TEST_P(EveryLaw, ElasticStressIsTheDerivativeOfTheEnergy) {
  Worst all;
  for_each_law([&](const Law& law) {
    if (!law.stress_from_energy) return;
    const Worst worst = energy_derivative(law, source, 500);
    EXPECT_LE(worst.error, 1e-8);
    all.add(worst);
  });
  if (family().laws().at(0).stress_from_energy) {
    EXPECT_GT(all.samples, 100);
  }
}

// The second-order term of the laws is a small multiple of e^2 times the stiffness: Hencky against
// linear strain gives about 4, a fluid (1 + gamma)/2. Clay, which starts under stress, stiffens by
// v/kappa of its volume strain, here 3 e: 9 v/kappa is 800. One per cent of a modulus is 3000.
TEST_P(EveryLaw, SmallStrainIsLinearElasticity) {
  Worst all;
  for (const std::any& input : family().inputs) all.add(small_strain(family(), input, source, 50));
  if (all.samples == 0) GTEST_SKIP() << "no input with a linear limit";
  const std::vector<Law> laws = family().laws();
  const bool stressed = norm(stress_at_rest(laws[0], laws[0].exact->initial())) > 0;
  EXPECT_LE(all.error, stressed ? 1000 : 100);
}

// 1e5 returns a law, singular values from 0.3 to 3 from fresh and from yielded states.
TEST_P(EveryLaw, StrongReturnsAreIdempotentAndInside) {
  const auto laws = family().laws();
  for (const Law& law : laws) {
    SCOPED_TRACE(law.name);
    const int count = effort(100000 / int(laws.size()));
    const Returned result = strong_returns<double>(law, source, count);
    EXPECT_GT(result.repeated.samples, count / 4);  // a fluid that sees tr L refuses many
    EXPECT_LE(result.repeated.error, 1e-12);
    EXPECT_LE(result.outside.error, 1e-10);
    if (result.outside.samples > 0 && law.has_field("deformation_gradient")) {
      EXPECT_GT(result.flowing, count / 20);
    }
  }
}

// Single precision: rounding 6e-8, ten roundings a decomposition, logarithms of 1/3 to 3.
TEST_P(EveryLaw, StrongReturnsInSinglePrecision) {
  const auto laws = family().laws();
  for (const Law& law : laws) {
    SCOPED_TRACE(law.name);
    const int count = effort(100000 / int(laws.size()));
    const Returned result = strong_returns<float>(law, source, count);
    EXPECT_LE(result.repeated.error, 2e-5);
    EXPECT_LE(result.outside.error, 1e-3);
  }
}

// Strength that falls with the strain of the same step is found by a fixed number of secant steps,
// to about 1e-5 of the increment; other laws are exact to the rounding of logarithms.
TEST_P(EveryLaw, PlasticStrainIsTheFlow) {
  for_each_law([this](const Law& law) {
    const Worst worst = plastic_strain(law, source, 1000);
    EXPECT_LE(worst.error, 1e-4);
  });
}

// 400 steps of 3e-4: the trapezoidal rule errs by 400 (3e-4)^3 = 1e-8 on smooth parts, and by
// (3e-4)^2 = 1e-7 where yielding begins or ends. J <- J (1 + tr L) of a fluid errs by the
// square of the step, which is 400 (3e-4)^2 times pressures of some percent of the stiffness. A law
// whose stress has no energy says so, and may gain that much on elastic cycles.
TEST_P(EveryLaw, ClosedPathsDissipate) {
  for_each_law([this](const Law& law) {
    const Dissipation d = dissipation(law, source, effort(40));
    const bool sees_rate = !law.has_field("log_volume_ratio") && !law.path_independent();
    EXPECT_GE(d.least, !law.stress_from_energy ? -2e-4 : sees_rate ? -1e-5 : -1e-6);
    if (law.path_independent()) {
      EXPECT_LE(d.most, 1e-7);
    }
  });
}

// First order: the difference halves with the step; yielding that begins within a step scatters
// the ratio, and a law that is smooth along most paths comes near to 4. All paths in every build:
// single ones scatter, the band is for their mean.
TEST_P(EveryLaw, HalvingTheStepsConverges) {
  for_each_law([this](const Law& law) {
    if (law.explicit_hardening) {
      // The surface lags by a step, so single halvings scatter: 16 times the steps must gain 3.
      MatrixSource same{21};
      const double coarse = halving(law, same, 200, 16).coarse;
      same = MatrixSource{21};
      EXPECT_GE(coarse / halving(law, same, 200, 256).coarse, 3);
      return;
    }
    const Halving h = halving(law, source, 200);
    if (law.path_independent()) {
      EXPECT_LE(h.coarse, 1e-13);  // the path does not matter, only its end
    } else if (h.coarse > 1e-12) {
      EXPECT_GE(h.coarse / h.fine, 1.6);
      EXPECT_LE(h.coarse / h.fine, 6);
    }
  });
}

// Rounding of F and the decomposition (about ten roundings of 6e-8), times the stiffness.
TEST_P(EveryLaw, SinglePrecisionStaysNearDouble) {
  for_each_law([this](const Law& law) {
    const Worst worst = single_against_double(law, source, 3000);
    EXPECT_LE(worst.error, 1e-5);
    EXPECT_GT(worst.samples, 3000);
  });
}

// 1e-4: error of the one-sided difference with strains of 1e-7.
TEST_P(EveryLaw, WaveSpeedBoundsTheTangent) {
  for_each_law([this](const Law& law) {
    for (const double size : {1e-4, 1e-3, 1e-2, 0.1}) {
      const Worst worst = wave_speed_excess(law, source, size, 150);
      // At the tip of an ellipse its slope has no bound, while the stress on it vanishes: a law
      // with explicit hardening reaches states there. They are rare.
      EXPECT_LE(worst.large, law.explicit_hardening ? worst.samples / 300 : 0) << worst.error;
    }
  });
}

// A loose bound costs time steps: the speed is at most 1.8 times too high (flow that is not
// associated adds to the bound, also in states that are elastic).
TEST_P(EveryLaw, WaveSpeedIsNotLoose) {
  for_each_law([this](const Law& law) {
    EXPECT_LE(wave_speed_looseness(law, source, 20).error, 1.8 * 1.8);
  });
}

TEST_P(EveryLaw, InvertedGradientIsNotAdmissibleAndDoesNotTrap) {
  const Eigen::Matrix3d gradients[] = {Eigen::Vector3d(-1, 1, 1).asDiagonal(),
                                       Eigen::Vector3d(0, 1, 1).asDiagonal(),
                                       Eigen::Matrix3d::Zero(), -Eigen::Matrix3d::Identity()};
  for_each_law([&](const Law& law) {
    for (const auto& f : gradients) EXPECT_TRUE(refuses(law, f)) << f;
  });
}

// A key that changes nothing is a parameter fixed in code.
TEST_P(EveryLaw, EveryKeyMatters) {
  EXPECT_EQ(idle_keys(family(), source), std::vector<std::string>{});
}

}  // namespace
}  // namespace scree::testing
