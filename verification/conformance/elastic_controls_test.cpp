// SPDX-License-Identifier: Apache-2.0
// The checks can fail: elastic laws that are wrong on purpose, each in one thing.
#include <gtest/gtest.h>

#include "verification/conformance/checks.hpp"
#include "verification/conformance/lane_law_of.hpp"
#include "verification/conformance/law_of.hpp"
#include "verification/conformance/samples/fixed_corotated.hpp"

namespace scree::testing {
namespace {

const FixedCorotated::Input rubber{1e7, 0.2};

class ElasticControl : public ::testing::Test {
 protected:
  MatrixSource source{31};
};

struct SwappedLameConstants : FixedCorotated {
  template <class T>
  static Params<T> params(const Input& in, double density, int dimension) {
    const Params<T> p = FixedCorotated::params<T>(in, density, dimension);
    return {p.mu, p.lambda, p.inverse_density};
  }
};

// Stress and energy agree with each other: only the moduli of the input tell.
TEST_F(ElasticControl, SwappedLameConstantsAreSeen) {
  const Family good = make_family<FixedCorotated>({rubber});
  EXPECT_LE(small_strain(good, good.inputs[0], source, 10).error, 100);
  const Family wrong = make_family<SwappedLameConstants>({rubber});
  EXPECT_GE(small_strain(wrong, wrong.inputs[0], source, 10).error, 1e4);
}

/// The volumetric energy lambda/2 (J - 1)^2 where its derivative lambda J (J - 1) belongs.
struct EnergyAsStress : FixedCorotated {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    const Sym3<V> tau = FixedCorotated::kirchhoff(p, s, L, dt);
    const V J = det(s.F);
    return detail::plus_diagonal(tau, p.lambda * (J - T(1)) * (T(0.5) * (J - T(1)) - J));
  }
};

TEST_F(ElasticControl, EnergyInPlaceOfStressIsSeen) {
  EXPECT_GE(energy_derivative(make_exact_law<EnergyAsStress>(rubber), source, 100).error, 1e-3);
}

/// Stress in the axes of the undeformed body: R is lost.
struct LostRotation : FixedCorotated {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    const Sym3<V> tau = FixedCorotated::kirchhoff(p, s, L, dt);
    const Mat3<V> R = polar_rotation(s.F);
    return sym(transpose(R) * to_mat(tau) * R);
  }
};

TEST_F(ElasticControl, LostRotationIsSeen) {
  EXPECT_GE(loss_of_objectivity(make_exact_law<LostRotation>(rubber), source, 100).error, 1e-3);
}

/// A fibre along the first axis of the undeformed body.
struct Fibre : FixedCorotated {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    Sym3<V> tau = FixedCorotated::kirchhoff(p, s, L, dt);
    const V x = s.F(0, 0), y = s.F(1, 0), z = s.F(2, 0);
    const V pull = (x * x + y * y + z * z - T(1)) * (T(0.1) * p.mu);
    return {tau.xx + pull * x * x, tau.xy + pull * x * y, tau.xz + pull * x * z,
            tau.yy + pull * y * y, tau.yz + pull * y * z, tau.zz + pull * z * z};
  }
};

TEST_F(ElasticControl, AnisotropyIsSeenAndIsObjective) {
  const Law law = make_exact_law<Fibre>(rubber);
  EXPECT_GE(loss_of_isotropy(law, source, 100).error, 1e-3);
  EXPECT_LE(loss_of_objectivity(law, source, 100).error, 1e-12);
}

/// Grows a little in every call.
struct Growing : FixedCorotated {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    s.F = s.F * T(1 + 1e-9);
    return FixedCorotated::kirchhoff(p, s, L, dt);
  }
};

TEST_F(ElasticControl, GrowthWithoutStrainIsSeen) {
  const Law law = make_exact_law<Growing>(rubber);
  EXPECT_GE(change_without_strain(law, source, 100).error, 1e-10);
  EXPECT_GE(loss_of_volume(law, source, 100).error, 1e-8);
  EXPECT_GE(halving(law, source, 10).coarse, 1e-9);
}

/// The bound of the wave speed 20 % too low.
struct SlowWaves : FixedCorotated {
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    return FixedCorotated::wave_speed(p, s) * T(0.8);
  }
};
struct FastWaves : FixedCorotated {
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    return FixedCorotated::wave_speed(p, s) * T(2);
  }
};

TEST_F(ElasticControl, WrongWaveSpeedsAreSeen) {
  EXPECT_GE(wave_speed_excess(make_exact_law<SlowWaves>(rubber), source, 1e-3, 100).error, 0.1);
  EXPECT_GE(wave_speed_looseness(make_exact_law<FastWaves>(rubber), source, 10).error, 3.9);
}

/// Accepts every state.
struct Careless : FixedCorotated {
  template <class V, class T>
  SCREE_FN static MaskOf<V> admissible(const Params<T>&, const State<V>& s) {
    return s.F(0, 0) == s.F(0, 0);
  }
};

TEST_F(ElasticControl, AcceptedInversionIsSeen) {
  const Eigen::Matrix3d inverted = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  EXPECT_TRUE(refuses(make_exact_law<FixedCorotated>(rubber), inverted));
  EXPECT_FALSE(refuses(make_exact_law<Careless>(rubber), inverted));
}

/// A branch that one lane takes for all.
struct OneForAll : FixedCorotated {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    const Sym3<V> tau = FixedCorotated::kirchhoff(p, s, L, dt);
    if (any(det(s.F) > T(2))) return tau * broadcast<V>(T(1.01));
    return tau;
  }
};

TEST_F(ElasticControl, LanesThatDependOnEachOtherAreSeen) {
  const Law law = make_exact_law<OneForAll>(rubber);
  const LaneLawOf<OneForAll, double> lanes(rubber);
  const LaneLawOf<OneForAll, float> single(rubber);
  EXPECT_EQ(lanes_against_scalars<double>(law, lanes, 1, source, 100).error, 0);
  EXPECT_GE(lanes_against_scalars<double>(law, lanes, 8, source, 100).error, 1e-4);
  EXPECT_GE(lanes_against_scalars<float>(law, single, 16, source, 100).error, 1e-4);
}

/// Digits lost on the way.
struct Cancelling : FixedCorotated {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    s.F = s.F + L * s.F;
    s.F(0, 0) = (s.F(0, 0) + T(3e4)) - T(3e4);
    return FixedCorotated::kirchhoff(p, s, zero3<V>(), dt);
  }
};

TEST_F(ElasticControl, LostDigitsInSinglePrecisionAreSeen) {
  const Law law = make_law<Cancelling>(rubber);
  EXPECT_GE(single_against_double(law, source, 100).error, 1e-4);
}

}  // namespace
}  // namespace scree::testing
