// SPDX-License-Identifier: Apache-2.0
/// \file
/// MaterialCalls of one law; included where CMake instantiates it.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <vector>

#include "materials/material.hpp"
#include "materials/material_cost.hpp"

namespace scree {

/// Batches of lanes that are strained to and fro.
template <class M, class T>
class MaterialCallsOf final : public MaterialCalls {
 public:
  using V = Lanes<T>;
  static constexpr int batches = 8;

  explicit MaterialCallsOf(const typename M::Input& input)
      : p_(M::template params<T>(input, 1700.0, 3)), batch_(batches) {
    std::uint32_t bits = 1;
    for (Batch& b : batch_) {
      for (int k = 0; k < 9; ++k) {
        for (int i = 0; i < lanes_of<V>; ++i) {
          bits = bits * 1664525u + 1013904223u;
          set_lane(b.increment(k / 3, k % 3), i, T(1e-3) * (T(bits >> 8) * T(0x1p-23) - T(1)));
        }
      }
    }
  }

  /// Forth in even rounds, back in odd ones.
  void round() override {
    if (rounds_ % cycle == 0) {
      for (Batch& b : batch_) b.state = M::template initial<V>(p_);
    }
    const V sign = broadcast<V>(rounds_++ % 2 == 0 ? T(1) : T(-1));
    for (Batch& b : batch_) b.stress = M::kirchhoff(p_, b.state, b.increment * sign, T(1e-3));
  }

  int particles() const override { return batches * lanes_of<V>; }

 private:
  /// Rounds from one undeformed state to the next: (I - L)(I + L) is not I, and what is left would
  /// add up to large strains.
  static constexpr int cycle = 256;

  struct Batch {
    typename M::template State<V> state;
    Mat3<V> increment;
    Sym3<V> stress;
  };
  typename M::template Params<T> p_;
  std::vector<Batch> batch_;
  int rounds_ = 0;
};

template <class M, class T>
std::unique_ptr<MaterialCalls> calls_of(const std::any& input) {
  return std::make_unique<MaterialCallsOf<M, T>>(std::any_cast<const typename M::Input&>(input));
}

}  // namespace scree
