// SPDX-License-Identifier: Apache-2.0
/// \file
/// LaneLaw of a C++ type; included where a law is compiled for the tests.
#pragma once

#include <cstring>

#include "verification/conformance/law.hpp"

namespace scree::testing {

template <class M, class T>
class LaneLawOf final : public LaneLaw<T> {
 public:
  explicit LaneLawOf(const typename M::Input& input)
      : p_(M::template params<T>(input, density, 3)) {}

  void run(int width, LaneRun<T>* runs) const override {
    if (width == 1) return run_in<T>(p_, runs);
    if (width == 4) return run_in<Pack<T, 4>>(p_, runs);
    if (width == 8) return run_in<Pack<T, 8>>(p_, runs);
    run_in<Pack<T, 16>>(p_, runs);
  }

 private:
  template <class V, class P>
  [[gnu::noinline]] static void run_in(const P& p, LaneRun<T>* runs) {
    using State = typename M::template State<V>;
    State state = M::template initial<V>(p);
    Sym3<V> tau{};
    for (int step = 0; step < 2; ++step) {
      Mat3<V> L = zero3<V>();
      for (int i = 0; i < lanes_of<V>; ++i) {
        const Mat3<T>& from = step == 0 ? runs[i].first : runs[i].second;
        for (int k = 0; k < 9; ++k) set_lane(L(k / 3, k % 3), i, from(k / 3, k % 3));
      }
      tau = M::kirchhoff(p, state, L, T(0.01));
    }
    const V c = M::wave_speed(p, state), e = M::energy_density(p, state);
    const V J = M::volume_ratio(p, state);
    const auto admissible = M::admissible(p, state);
    constexpr int count = int(sizeof(State) / sizeof(V));
    V entries[count];
    std::memcpy(static_cast<void*>(entries), &state, sizeof state);
    for (int i = 0; i < lanes_of<V>; ++i) {
      LaneRun<T>& r = runs[i];
      r.state = {};
      for (int k = 0; k < count; ++k) r.state[std::size_t(k)] = lane(entries[k], i);
      r.stress = {lane(tau.xx, i), lane(tau.xy, i), lane(tau.xz, i),
                  lane(tau.yy, i), lane(tau.yz, i), lane(tau.zz, i)};
      r.wave_speed = lane(c, i);
      r.energy_density = lane(e, i);
      r.volume_ratio = lane(J, i);
      r.admissible = lane(admissible, i);
    }
  }

  typename M::template Params<T> p_;
};

}  // namespace scree::testing
