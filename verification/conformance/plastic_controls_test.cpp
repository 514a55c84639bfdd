// SPDX-License-Identifier: Apache-2.0
// The checks can fail: laws with yield surfaces that are wrong on purpose, each in one thing.
#include <gtest/gtest.h>

#include "verification/conformance/checks.hpp"
#include "verification/conformance/law_of.hpp"
#include "verification/conformance/samples/drucker_prager.hpp"
#include "verification/conformance/samples/von_mises.hpp"

namespace scree::testing {
namespace {

const VonMises::Input metal{1e7, 0.3, 1e5, 1e6};

DruckerPrager::Input sand(double friction, double dilation) {
  DruckerPrager::Input in;
  in.youngs_modulus = 1e7;
  in.poissons_ratio = 0.3;
  in.friction_angle = friction * degree;
  in.dilation_angle = dilation * degree;
  in.match = Match::compression;
  return in;
}

class PlasticControl : public ::testing::Test {
 protected:
  MatrixSource source{32};
};

/// The update of the history inside of a loop over the nine components.
struct HardensNineTimes : VonMises {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    const V before = s.equivalent_plastic_strain;
    const Sym3<V> tau = VonMises::kirchhoff(p, s, L, dt);
    s.equivalent_plastic_strain = before + T(9) * (s.equivalent_plastic_strain - before);
    return tau;
  }
};

TEST_F(PlasticControl, HardeningNineTimesIsSeen) {
  EXPECT_GE(plastic_strain(make_exact_law<HardensNineTimes>(metal), source, 100).error, 0.1);
}

/// Hardens by the number of steps, not by the flow.
struct HardensByTheStep : VonMises {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    const V before = s.equivalent_plastic_strain;
    const Sym3<V> tau = VonMises::kirchhoff(p, s, L, dt);
    const V flown = s.equivalent_plastic_strain - before;
    s.equivalent_plastic_strain = before + select(flown > T(0), T(1e-3), flown);
    return tau;
  }
};

TEST_F(PlasticControl, HardeningByTheStepIsSeen) {
  const Halving h = halving(make_exact_law<HardensByTheStep>(metal), source, 50);
  EXPECT_GT(h.coarse, 1e-6);
  EXPECT_LT(h.coarse / h.fine, 1);
}

/// No return: the yield stress that the return sees is out of reach.
struct WithoutReturn : VonMises {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(Params<T> p, State<V>& s, const Mat3<V>& L, T dt) {
    p.radius = T(1e3);
    return VonMises::kirchhoff(p, s, L, dt);
  }
};
/// Goes half of the way from the trial state.
struct HalfReturn : VonMises {
  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    const Mat3<V> trial = s.F + L * s.F;
    const Sym3<V> tau = VonMises::kirchhoff(p, s, L, dt);
    s.F = (s.F + trial) * T(0.5);
    return tau;
  }
};

TEST_F(PlasticControl, WrongReturnsAreSeen) {
  const Returned good = strong_returns<double>(make_exact_law<VonMises>(metal), source, 100);
  EXPECT_LE(good.repeated.error, 1e-12);
  EXPECT_LE(good.outside.error, 1e-10);
  EXPECT_GT(good.flowing, 50);
  const Returned none = strong_returns<double>(make_exact_law<WithoutReturn>(metal), source, 100);
  EXPECT_GE(none.outside.error, 1e-3);
  EXPECT_EQ(none.flowing, 0);
  const Returned half = strong_returns<double>(make_exact_law<HalfReturn>(metal), source, 100);
  EXPECT_GE(half.repeated.error, 1e-3);
  EXPECT_GE(half.outside.error, 1e-3);
}

struct FixedFrictionAngle : DruckerPrager {
  template <class T>
  static Params<T> params(Input in, double density, int dimension) {
    in.friction_angle = 30 * degree;
    return DruckerPrager::params<T>(in, density, dimension);
  }
};

TEST_F(PlasticControl, FrictionAngleFixedInCodeIsSeen) {
  const std::vector<std::string> idle =
      idle_keys(make_family<FixedFrictionAngle>({sand(35, 10)}), source);
  EXPECT_NE(std::find(idle.begin(), idle.end(), "friction_angle"), idle.end());
  EXPECT_EQ(std::find(idle.begin(), idle.end(), "dilation_angle"), idle.end());
}

/// J of the elastic part in place of the total one.
struct ForgottenVolume : DruckerPrager {
  template <class V, class T>
  SCREE_FN static V volume_ratio(const Params<T>&, const State<V>& s) {
    return det(s.F);
  }
};

TEST_F(PlasticControl, ForgottenTotalVolumeIsSeen) {
  EXPECT_LE(loss_of_volume(make_exact_law<DruckerPrager>(sand(30, 10)), source, 50).error, 1e-12);
  EXPECT_GE(loss_of_volume(make_exact_law<ForgottenVolume>(sand(30, 10)), source, 50).error, 1e-3);
}

// The schema refuses it; the law computes it.
TEST_F(PlasticControl, EnergyFromDilationAboveFrictionIsSeen) {
  EXPECT_GE(dissipation(make_exact_law<DruckerPrager>(sand(20, 20)), source, 20).least, -1e-6);
  EXPECT_LE(dissipation(make_exact_law<DruckerPrager>(sand(20, 45)), source, 20).least, -1e-5);
}

}  // namespace
}  // namespace scree::testing
