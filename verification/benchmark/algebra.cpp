// SPDX-License-Identifier: Apache-2.0
//
// Decompositions of one tensor a lane, and the register transposes, on data in the first cache.
#include "solver/base/eigen.hpp"
#include "solver/base/eigen_closed.hpp"
#include "solver/base/polar.hpp"
#include "solver/base/svd.hpp"
#include "solver/exec/aligned.hpp"
#include "solver/exec/transpose.hpp"
#include "verification/benchmark/benchmarks.hpp"
#include "verification/support/random.hpp"

namespace scree::benchmarks {
namespace {

constexpr int batches = 8;

/// Stretched, sheared and turned by up to a tenth.
template <class V>
std::vector<Mat3<V>> gradients() {
  testing::Random random(17);
  std::vector<Mat3<V>> all(batches, identity3<V>());
  for (Mat3<V>& F : all) {
    for (int k = 0; k < 9; ++k) {
      V& x = F(k / 3, k % 3);
      for (int i = 0; i < lanes_of<V>; ++i) {
        set_lane(x, i, lane(x, i) + Scalar<V>(random.uniform(-0.1, 0.1)));
      }
    }
  }
  return all;
}

/// f(deformation gradient) in lanes.
template <class T, class F>
void add_decomposition(const std::string& name, F f) {
  add(name + "/" + real_name<T>, [f](benchmark::State& state) {
    using V = Lanes<T>;
    const std::vector<Mat3<V>> input = gradients<V>();
    std::vector<decltype(f(input[0]))> output(batches);
    benchmark::DoNotOptimize(input.data());
    benchmark::DoNotOptimize(output.data());
    for (auto _ : state) {
      for (int b = 0; b < batches; ++b) output[std::size_t(b)] = f(input[std::size_t(b)]);
      benchmark::ClobberMemory();
    }
    count(state, batches * lanes_of<V>, "tensor");
  });
}

/// f(from, to): one record of 16 numbers a particle.
template <class T, class F>
void add_transpose(const std::string& name, F f) {
  add(name + "/" + real_name<T>, [f](benchmark::State& state) {
    constexpr int width = LaneTranspose<T>::width, size = width * LaneTranspose<T>::record;
    testing::Random random(19);
    AlignedVector<T> from(std::size_t(batches * size)), to(std::size_t(batches * size));
    for (T& x : from) x = T(random.uniform(-1, 1));
    benchmark::DoNotOptimize(from.data());
    benchmark::DoNotOptimize(to.data());
    for (auto _ : state) {
      for (int b = 0; b < batches; ++b) f(from.data() + b * size, to.data() + b * size);
      benchmark::ClobberMemory();
    }
    count(state, batches * width, "particle");
  });
}

template <class T>
void add_of() {
  using V = Lanes<T>;
  add_transpose<T>("to_records", LaneTranspose<T>::to_records);
  add_transpose<T>("to_lanes", LaneTranspose<T>::to_lanes);
  add_decomposition<T>("symmetric_product", [](const Mat3<V>& F) { return symmetric_product(F); });
  add_decomposition<T>("eigen_symmetric",
                       [](const Mat3<V>& F) { return eigen_symmetric(symmetric_product(F)); });
  add_decomposition<T>("eigen_symmetric_closed", [](const Mat3<V>& F) {
    return eigen_symmetric_closed(symmetric_product(F));
  });
  add_decomposition<T>("polar_rotation", [](const Mat3<V>& F) { return polar_rotation(F); });
  add_decomposition<T>("svd", [](const Mat3<V>& F) { return svd(F); });
}

}  // namespace

void add_algebra() {
  add_of<float>();
  add_of<double>();
}

}  // namespace scree::benchmarks
