// SPDX-License-Identifier: Apache-2.0
/// \file
/// material_cost() of one law; included where CMake instantiates it.
#pragma once

#include <algorithm>
#include <any>
#include <chrono>
#include <cstdint>
#include <vector>

#include "materials/material.hpp"

namespace scree {

/// The work of the measurement: batches of lanes that are strained to and fro.
template <class M, class T>
class MaterialWork {
 public:
  using V = Lanes<T>;
  static constexpr int batches = 8;

  explicit MaterialWork(const typename M::Input& input)
      : p_(M::template params<T>(input, 1700.0, 3)), batch_(batches) {
    std::uint32_t bits = 1;
    for (Batch& b : batch_) {
      b.state = M::template initial<V>(p_);
      for (int k = 0; k < 9; ++k) {
        for (int i = 0; i < lanes_of<V>; ++i) {
          bits = bits * 1664525u + 1013904223u;
          set_lane(b.increment(k / 3, k % 3), i, T(1e-3) * (T(bits >> 8) * T(0x1p-23) - T(1)));
        }
      }
    }
  }

  /// One call for every particle; forth in even rounds, back in odd ones.
  [[gnu::noinline]] void round(bool back) {
    for (Batch& b : batch_) {
      const Mat3<V> L = b.increment * broadcast<V>(back ? T(-1) : T(1));
      b.stress = M::kirchhoff(p_, b.state, L, T(1e-3));
    }
  }

  static constexpr int particles() { return batches * lanes_of<V>; }

 private:
  struct Batch {
    typename M::template State<V> state;
    Mat3<V> increment;
    Sym3<V> stress;
  };
  typename M::template Params<T> p_;
  std::vector<Batch> batch_;
};

template <class M, class T>
double cost_of(const std::any& input, double seconds) {
  using Clock = std::chrono::steady_clock;
  MaterialWork<M, T> work(std::any_cast<const typename M::Input&>(input));
  constexpr int rounds = 200;
  double best = 1e300;
  const auto start = Clock::now();
  do {
    const auto begin = Clock::now();
    for (int n = 0; n < rounds; ++n) work.round(n % 2 == 1);
    const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
    best = std::min(best, elapsed);
  } while (std::chrono::duration<double>(Clock::now() - start).count() < seconds);
  return 1e9 * best / (double(rounds) * MaterialWork<M, T>::particles());
}

}  // namespace scree
