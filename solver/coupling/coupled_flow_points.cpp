// SPDX-License-Identifier: Apache-2.0
// The particles' part in the step of the pore water.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/coupling/coupled_flow.hpp"
#include "solver/coupling/load_any.hpp"
#include "solver/exec/transpose.hpp"

namespace scree {
namespace {

using Wide = Lanes<double>;

Wide determinant(const Wide (&f)[2][2]) { return f[0][0] * f[1][1] - f[0][1] * f[1][0]; }

Wide determinant(const Wide (&f)[3][3]) {
  return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
         f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
         f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

/// States of particles in lanes: row k holds their k-th number.
template <int D>
struct StateLanes {
  static constexpr int width = FlowIncrements<D>::width;
  static constexpr int rows = 16, numbers = int(sizeof(PoreState<D>) / sizeof(double));
  /// Rows of the numbers after F.
  static constexpr int pressure = D * D, ratio = pressure + 1, start_ratio = pressure + 2;
  static_assert(numbers <= rows && offsetof(PoreState<D>, start_ratio) == 8 * start_ratio);
  using Turn = LaneTranspose<double>;
  static_assert(width % Turn::width == 0 && rows == Turn::record);
  alignas(64) double numbers_of[rows * width] = {};

  double* row(int k) { return numbers_of + k * width; }

  /// f(first lane, room for its rows) for as many lanes as are turned at once.
  template <class F>
  void each_part(F&& f) {
    for (int first = 0; first < width; first += Turn::width) {
      alignas(64) double part[rows * Turn::width];
      f(first, part);
    }
  }

  /// state(i): of lane i.
  template <class State>
  void load(State&& state) {
    if constexpr (numbers == rows) {
      alignas(64) double records[width * rows];
      for (int i = 0; i < width; ++i) __builtin_memcpy(records + i * rows, &state(i), 8 * rows);
      each_part([&](int first, double* part) {
        Turn::to_lanes(records + first * rows, part);
        for (int k = 0; k < rows; ++k)
          std::copy_n(part + k * Turn::width, Turn::width, row(k) + first);
      });
    } else {
      for (int i = 0; i < width; ++i) {
        double record[numbers];
        __builtin_memcpy(record, &state(i), sizeof record);
        for (int k = 0; k < numbers; ++k) row(k)[i] = record[k];
      }
    }
  }
  /// F and ratio of the first `count` lanes; the pressure, which lies between them, as it was.
  template <class State>
  void save(State&& state, int count) {
    constexpr std::size_t bytes = 8 * (ratio + 1);
    if constexpr (numbers == rows) {
      alignas(64) double records[width * rows];
      each_part([&](int first, double* part) {
        for (int k = 0; k < rows; ++k)
          std::copy_n(row(k) + first, Turn::width, part + k * Turn::width);
        Turn::to_records(part, records + first * rows);
      });
      for (int i = 0; i < count; ++i) __builtin_memcpy(&state(i), records + i * rows, bytes);
    } else {
      for (int i = 0; i < count; ++i) {
        double record[ratio + 1];
        for (int k = 0; k <= ratio; ++k) record[k] = row(k)[i];
        __builtin_memcpy(&state(i), record, bytes);
      }
    }
  }
};

/// Value and gradient [1/h] at particles of a cell, from its corners; hat[a]: those of axis a.
template <int D>
void interpolate(const double (&nodal)[1 << D], const Wide (&hat)[D][2], Wide& value,
                 Wide (&gradient)[D]) {
  value = broadcast<Wide>(0.0);
  for (int a = 0; a < D; ++a) gradient[a] = broadcast<Wide>(0.0);
  for (int k = 0; k < (1 << D); ++k) {
    Wide n = broadcast<Wide>(nodal[k]);
    for (int a = 0; a < D; ++a) {
      Wide slope = broadcast<Wide>((k >> (D - 1 - a) & 1) != 0 ? nodal[k] : -nodal[k]);
      for (int b = 0; b < D; ++b) {
        if (b != a) slope = slope * hat[b][k >> (D - 1 - b) & 1];
      }
      gradient[a] = gradient[a] + slope;
      n = n * hat[a][k >> (D - 1 - a) & 1];
    }
    value = value + n;
  }
}

}  // namespace

template <int D>
Mat3<double> CoupledFlow<D>::deformation(std::int64_t id) const {
  Mat3<double> f = identity3<double>();
  for (int i = 0; i < D * D; ++i) {
    f(i / D, i % D) = state_[std::size_t(id)].deformation[i];
  }
  return f;
}

template <int D>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void CoupledFlow<D>::fill(const FlowIncrements<D>& increments, std::int32_t body) {
  constexpr int width = FlowIncrements<D>::width;
  const FlowBody& flow = bodies_[std::size_t(body)];
  const PoreSetup& pores = *flow.pores;
  const auto state = [&](int i) -> PoreState<D>& {
    const std::int64_t point = increments.point[i < increments.count ? i : 0];
    return state_[std::size_t(points_.id[std::size_t(point)])];
  };
  StateLanes<D> lanes;  // padding repeats the first
  lanes.load(state);
  Wide c[D][D], f[D][D], trace = broadcast<Wide>(0.0);
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) c[a][b] = scree::load<Wide>(increments.value[a * D + b]);
    trace = trace + c[a][a];
  }
  alignas(64) double half[D][width], volume[width], capacity[width], mobility[width],
      content[width];
  Wide now[D][D];
  const double side = half_side_[std::size_t(body)] / h_;
  for (int a = 0; a < D; ++a) {
    Wide square = broadcast<Wide>(0.0);
    for (int b = 0; b < D; ++b) {
      Wide sum = scree::load<Wide>(lanes.row(a * D + b));
      for (int k = 0; k < D; ++k) {
        sum = mul_add(c[a][k], scree::load<Wide>(lanes.row(k * D + b)), sum);
      }
      now[a][b] = sum;
      square = mul_add(sum, sum, square);
      f[a][b] = a == b ? c[a][b] + 1.0 : c[a][b];
    }
    store(half[a], side * min(sqrt(square), longest_box));
  }
  const Wide before = scree::load<Wide>(lanes.row(lanes.ratio));
  const Wide start = scree::load<Wide>(lanes.row(lanes.start_ratio));
  const Wide ratio = before * determinant(f);
  const Wide porosity = 1.0 - ((1 - pores.porosity) * start) / ratio;
  const Wide storage =
      porosity * (1 / pores.fluid_modulus) + (pores.biot - porosity) * pores.grain_compliance;
  const Wide space = ratio * flow.particle_volume, room = space * storage;
  const Wide defect = (ratio - before * (trace + 1.0)) * (pores.biot * flow.particle_volume);
  Wide k = broadcast<Wide>(pores.mobility);
  if (pores.kozeny_carman) {
    const Wide r = porosity / pores.porosity, s = (1 - pores.porosity) / (1.0 - porosity);
    k = k * (r * r * r * s * s);
  }
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) store(lanes.row(a * D + b), now[a][b]);
  }
  store(lanes.row(lanes.ratio), ratio);
  store(volume, space);
  store(capacity, room);
  store(mobility, k);
  store(content, room * scree::load<Wide>(lanes.row(lanes.pressure)) - defect);
  lanes.save(state, increments.count);
  for (int i = 0; i < increments.count; ++i) {
    const std::size_t p = std::size_t(increments.point[i]);
    for (std::size_t a = 0; a < D; ++a) points_.half[a][p] = half[a][i];
    points_.volume[p] = volume[i];
    points_.capacity[p] = capacity[i];
    points_.mobility[p] = mobility[i];
    points_.content[p] = content[i];
  }
}

/// Water of particles that have gone since the last step counts as outflow.
template <int D>
void CoupledFlow<D>::index_points() {
  const std::vector<std::int64_t>& ids = points_.id;
  if (std::int64_t(ids.size()) == present_) {  // the same particles
    for (std::size_t i = 0; i < ids.size(); ++i) point_of_[std::size_t(ids[i])] = std::int32_t(i);
    return;
  }
  std::vector<std::int32_t> now(point_of_.size(), -1);
  for (std::size_t i = 0; i < ids.size(); ++i) now[std::size_t(ids[i])] = std::int32_t(i);
  std::size_t body = 0;
  for (std::size_t id = 0; id < now.size(); ++id) {
    while (body + 1 < bodies_.size() && std::int64_t(id) >= bodies_[body + 1].first_id) ++body;
    if (point_of_[id] < 0 || now[id] >= 0) continue;
    left_ += fluid_mass(std::int32_t(body), std::int64_t(id), state_[id].ratio);
  }
  point_of_ = std::move(now);
  present_ = std::int64_t(ids.size());
}

template <int D>
std::optional<SurfacePoint<D>> CoupledFlow<D>::surface_point(std::int64_t id) const {
  const std::int64_t index = point_of_[std::size_t(id)];
  if (index < 0) return std::nullopt;
  const FlowChunk<D>& chunk = points_.chunk_of(index);
  SurfacePoint<D> point;
  for (const FlowRun<D>& run : chunk.runs) {
    if (index >= run.begin && index < run.end) point.cell = run.cell;
  }
  for (std::size_t a = 0; a < D; ++a) point.xi[a] = points_.xi[a][std::size_t(index)];
  point.mobility = points_.mobility[std::size_t(index)];
  point.fluid_density = bodies_[std::size_t(chunk.body)].pores->fluid_density;
  return point;
}

/// Pressure and seepage of the particles.
template <int D>
void CoupledFlow<D>::gather(double dt, const std::array<double, 3>& gravity, ThreadPool& pool) {
  pool.for_each(std::int64_t(points_.chunks.size()), [&](std::int64_t c, int) {
    const FlowChunk<D>& chunk = points_.chunks[std::size_t(c)];
    for (const FlowRun<D>& run : chunk.runs) gather_run(run, chunk.body, gravity);
  });
  surfaces_.add_outflow(matrix_, solution_, dt, outflow_);
}

template <int D>
void CoupledFlow<D>::gather_run(const FlowRun<D>& run, std::int32_t body,
                                const std::array<double, 3>& gravity) {
  constexpr int corners = 1 << D;
  const FlowBody& flow = bodies_[std::size_t(body)];
  const double density = flow.pores->fluid_density;
  double nodal[corners];
  for (int k = 0; k < corners; ++k) {
    nodal[k] = solution_[std::size_t(matrix_.row(corner<D>(run.cell, k)))];
  }
  constexpr int width = lanes_of<Wide>;
  for (std::int64_t first = run.begin; first < run.end; first += width) {
    const std::int64_t coming =
        std::min<std::int64_t>(first + 2 * width, std::int64_t(points_.id.size()));
    for (std::int64_t p = std::min(first + width, coming); p < coming; ++p)
      prefetch(points_.id[std::size_t(p)]);
    Wide hat[D][2], value, gradient[D];
    for (std::size_t a = 0; a < D; ++a) {
      hat[a][1] = load_any<Wide>(points_.xi[a].data() + first);
      hat[a][0] = 1.0 - hat[a][1];
    }
    interpolate<D>(nodal, hat, value, gradient);
    alignas(64) double pressure[width], seepage[D][width];
    store(pressure, value);
    const Wide mobility = load_any<Wide>(points_.mobility.data() + first);
    for (int a = 0; a < D; ++a) {
      store(seepage[a], -mobility * (gradient[a] * (1 / h_) - density * gravity[std::size_t(a)]));
    }
    for (int i = 0; i < int(std::min<std::int64_t>(width, run.end - first)); ++i) {
      const std::size_t p = std::size_t(first + i);
      PoreState<D>& state = state_[std::size_t(points_.id[p])];
      state.stored += points_.capacity[p] * (pressure[i] - state.pressure);
      state.pressure = pressure[i];
      for (int a = 0; a < D; ++a) state.seepage[a] = seepage[a][i];
      gained_[std::size_t(points_.id[p])] = gain(flow, state);
    }
  }
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
