// SPDX-License-Identifier: Apache-2.0
// Q^T M^-1 Q, Q^T v and Q p, group by group of dense rows.
#include <algorithm>
#include <cmath>

#include "solver/coupling/volume_operator.hpp"

namespace scree {
namespace {

using Quad = Pack<double, 4>;

/// Rows of a group times the roots of their factors.
template <int N, int most>
struct Rows {
  alignas(64) double row[most * N];
  int count = 0;
};

/// sums = rows^T rows in 4 rows from j on and 4 W columns from l on of a matrix N wide.
template <int N, int W, int most>
void add_square(const Rows<N, most>& rows, int j, int l, double* sums) {
  Quad sum[4][W];
  for (auto& line : sum) {
    for (Quad& x : line) x = broadcast<Quad>(0.0);
  }
  for (int r = 0; r < rows.count; ++r) {
    const double* left = rows.row + r * N + j;
    const double* right = rows.row + r * N + l;
    Quad columns[W];
    for (int w = 0; w < W; ++w) columns[w] = load<Quad>(right + 4 * w);
    SCREE_UNROLL for (int i = 0; i < 4; ++i) {
      const Quad x = broadcast<Quad>(left[i]);
      SCREE_UNROLL for (int w = 0; w < W; ++w) sum[i][w] = mul_add(x, columns[w], sum[i][w]);
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int w = 0; w < W; ++w) store(sums + (j + i) * N + l + 4 * w, sum[i][w]);
  }
}

/// The upper triangle of rows^T rows, in squares of 4: what lies in a square below the diagonal
/// is of no use.
template <int N, int most>
void outer_products(const Rows<N, most>& rows, double* sums) {
  for (int j = 0; j < N; j += 4) {
    int l = j;
    for (; l + 12 <= N; l += 12) add_square<N, 3>(rows, j, l, sums);
    if (l + 8 == N) add_square<N, 2>(rows, j, l, sums);
    if (l + 4 == N) add_square<N, 1>(rows, j, l, sums);
  }
}

template <int N>
double dot(const double* a, const double* b) {
  Quad sum = load<Quad>(a) * load<Quad>(b);
  SCREE_UNROLL for (int j = 4; j < N; j += 4) {
    sum = mul_add(load<Quad>(a + j), load<Quad>(b + j), sum);
  }
  return (lane(sum, 0) + lane(sum, 2)) + (lane(sum, 1) + lane(sum, 3));
}

/// Entries of a group's triangle that lie together in the stencil of a row of the matrix.
struct HatRun {
  int row, column, place, count;
};

template <int D>
std::vector<HatRun> hat_runs(const VolumeOperator<D>& q, const PressureMatrix<D>& matrix) {
  std::vector<HatRun> runs;
  for (int j = 0; j < q.hats(); ++j) {
    for (int l = j; l < q.hats(); ++l) {
      const int place = matrix.offset_index(q.hat(j), q.hat(l)) - matrix.centre();
      if (l > j && place == runs.back().place + runs.back().count) {
        ++runs.back().count;
      } else {
        runs.push_back({j, l, place, 1});
      }
    }
  }
  return runs;
}

}  // namespace

template <int D>
template <class F>
void VolumeOperator<D>::each_pencil(ThreadPool& pool, F&& f) const {
  for (const auto& colour : colours_) {
    const auto run = [&](std::int64_t i, int) {
      const auto& [begin, end] = pencils_[std::size_t(colour[std::size_t(i)])];
      f(std::size_t(begin), std::size_t(end));
    };
    if (!lattice_.periodic()) {
      pool.for_each(std::int64_t(colour.size()), run);
      continue;
    }
    // Groups on both sides of a periodic face may share nodes whatever their colours.
    for (std::size_t i = 0; i < colour.size(); ++i) run(std::int64_t(i), 0);
  }
}

template <int D>
template <int N>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void VolumeOperator<D>::add_groups(const std::vector<InverseMass<D>>& inverse, double schur,
                                   PressureMatrix<D>& matrix, ThreadPool& pool) const {
  constexpr int most = D * 2 * power(2, D);  // two lattices, two nodes an axis
  const std::vector<HatRun> runs = hat_runs(*this, matrix);
  const auto add_group = [&](std::size_t group) {
    Rows<N, most> rows;
    alignas(64) double sums[N * N];
    for (int s = 0; s < slots_; ++s) {
      const std::size_t place = group * std::size_t(slots_) + std::size_t(s);
      if (empty_[place] != 0) continue;
      const InverseMass<D>& m = inverse[std::size_t(record_[place])];
      for (std::size_t a = 0; a < D; ++a) {
        const double scale = schur * m[a];
        if (m[0] < 0 || scale == 0) continue;
        const double* q = q_.data() + (place * D + a) * N;
        const double root = std::sqrt(scale);
        double* row = rows.row + rows.count++ * N;
        for (int j = 0; j < N; ++j) row[j] = root * q[j];
      }
    }
    if (rows.count == 0) return;
    std::int32_t number[N];
    group_rows(group, matrix, number);
    outer_products<N, most>(rows, sums);
    for (const HatRun& run : runs) {
      if (number[run.row] < 0) continue;
      double* to = matrix.stencil(number[run.row]) + run.place;
      const double* from = sums + run.row * N + run.column;
      for (int i = 0; i < run.count; ++i) to[i] += from[i];
    }
  };
  each_pencil(pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) add_group(group);
  });
}

template <int D>
void VolumeOperator<D>::add(const std::vector<InverseMass<D>>& inverse, double schur,
                            PressureMatrix<D>& matrix, ThreadPool& pool) const {
  constexpr int narrow = (power(3, D) + 3) / 4 * 4, wide = power(4, D);
  if (width_ == 3) {
    add_groups<narrow>(inverse, schur, matrix, pool);
  } else {
    add_groups<wide>(inverse, schur, matrix, pool);
  }
}

template <int D>
template <int N>
void VolumeOperator<D>::subtract_group(std::size_t group, const NodeVelocities& velocity,
                                       double rate, PressureMatrix<D>& matrix) const {
  Quad rates[N / 4];
  for (Quad& r : rates) r = broadcast<Quad>(0.0);
  bool moves = false;
  for (int s = 0; s < slots_; ++s) {
    const std::size_t place = group * std::size_t(slots_) + std::size_t(s);
    if (empty_[place] != 0) continue;
    const double* v = velocity[record_[place]];
    for (std::size_t a = 0; a < D; ++a) {
      if (v[a] == 0) continue;
      moves = true;
      const double* q = q_.data() + (place * D + a) * N;
      const Quad speed = broadcast<Quad>(v[a]);
      SCREE_UNROLL for (int j = 0; j < N / 4; ++j) {
        rates[j] = mul_add(scree::load<Quad>(q + 4 * j), speed, rates[j]);
      }
    }
  }
  if (!moves) return;
  std::int32_t number[N];
  group_rows(group, matrix, number);
  for (int j = 0; j < hats_; ++j) {
    if (number[j] < 0) continue;
    matrix.rhs()[std::size_t(number[j])] -= rate * lane(rates[j / 4], j % 4);
  }
}

template <int D>
void VolumeOperator<D>::subtract_rates(const NodeVelocities& velocity, double rate,
                                       PressureMatrix<D>& matrix, ThreadPool& pool) const {
  constexpr int narrow = (power(3, D) + 3) / 4 * 4, wide = power(4, D);
  each_pencil(pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) {
      if (width_ == 3) {
        subtract_group<narrow>(group, velocity, rate, matrix);
      } else {
        subtract_group<wide>(group, velocity, rate, matrix);
      }
    }
  });
}

template <int D>
template <int N>
void VolumeOperator<D>::push_group(std::size_t group, const double* pressure,
                                   const InverseMass<D>* inverse, double dt,
                                   const NodeVelocities& velocity, double* force) const {
  for (int s = 0; s < slots_; ++s) {
    const std::size_t place = group * std::size_t(slots_) + std::size_t(s);
    if (record_[place] < 0) continue;
    const std::size_t record = std::size_t(record_[place]);
    if (empty_[place] != 0) {
      std::fill(force + record * D, force + (record + 1) * D, 0.0);
      continue;
    }
    const bool held = inverse[record][0] < 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double f = dot<N>(q_.data() + (place * D + a) * N, pressure);
      force[record * D + a] = f;
      if (!held) velocity[std::int64_t(record)][a] += dt * inverse[record][a] * f;
    }
  }
}

template <int D>
void VolumeOperator<D>::push(const PressureMatrix<D>& matrix, const std::vector<double>& pressure,
                             const std::vector<InverseMass<D>>& inverse, double dt,
                             const NodeVelocities& velocity, std::vector<double>& force,
                             ThreadPool& pool) const {
  constexpr int narrow = (power(3, D) + 3) / 4 * 4, wide = power(4, D);
  force.resize(place_.size() * D);
  const auto push_one = [&](std::int64_t number, int) {
    const std::size_t group = std::size_t(number);
    alignas(64) double p[wide] = {};
    std::int32_t row[wide];
    group_rows(group, matrix, row);
    for (int j = 0; j < hats_; ++j) {
      if (row[j] >= 0) p[j] = pressure[std::size_t(row[j])];
    }
    if (width_ == 3) {
      push_group<narrow>(group, p, inverse.data(), dt, velocity, force.data());
    } else {
      push_group<wide>(group, p, inverse.data(), dt, velocity, force.data());
    }
  };
  pool.for_each(std::int64_t(groups_.size()), push_one, 64);
}

template class VolumeOperator<2>;
template class VolumeOperator<3>;

}  // namespace scree
