// SPDX-License-Identifier: Apache-2.0
// The particles' part in the step of the pore water.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "solver/coupling/coupled_flow.hpp"
#include "solver/coupling/load_any.hpp"

namespace scree {
namespace {

using Wide = Lanes<double>;

Wide determinant(const Wide (&f)[2][2]) { return f[0][0] * f[1][1] - f[0][1] * f[1][0]; }

Wide determinant(const Wide (&f)[3][3]) {
  return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
         f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
         f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

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
void set_growth(FlowVector<D>& particles) {
  Wide f[D][D];
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      f[a][b] = load<Wide>(particles.increment[a * D + b]) + (a == b ? 1.0 : 0.0);
    }
  }
  store(particles.growth, determinant(f) - 1.0);
}

template void set_growth(FlowVector<2>&);
template void set_growth(FlowVector<3>&);

template <int D>
Mat3<double> CoupledFlow<D>::deformation(std::int64_t id) const {
  Mat3<double> f = identity3<double>();
  for (int i = 0; i < D * D; ++i) {
    f(i / D, i % D) = number(id, PoreRow<D>::deformation + i);
  }
  return f;
}

template <int D>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void CoupledFlow<D>::fill(const FlowVector<D>& particles, const FlowChunk<D>& chunk,
                          FlowPoints<D>& points) {
  constexpr int width = FlowVector<D>::width;
  const FlowBody& flow = bodies_[std::size_t(chunk.body)];
  const PoreSetup& pores = *flow.pores;
  using Row = PoreRow<D>;
  auto& state = states_.vector(particles.place).row;
  Wide c[D][D], trace = broadcast<Wide>(0.0);
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) c[a][b] = scree::load<Wide>(particles.increment[a * D + b]);
    trace = trace + c[a][a];
  }
  constexpr int fields = 3 * D + 5;  // as they are listed below
  alignas(64) double value[fields][width];
  Wide now[D][D];
  const double side = half_side_[std::size_t(chunk.body)] / h_;
  for (int a = 0; a < D; ++a) {
    Wide square = broadcast<Wide>(0.0);
    for (int b = 0; b < D; ++b) {
      Wide sum = scree::load<Wide>(state[a * D + b]);
      for (int k = 0; k < D; ++k) {
        sum = mul_add(c[a][k], scree::load<Wide>(state[k * D + b]), sum);
      }
      now[a][b] = sum;
      square = mul_add(sum, sum, square);
    }
    store(value[2 * D + a], side * min(sqrt(square), longest_box));
  }
  const Wide before = scree::load<Wide>(state[Row::ratio]);
  const Wide start = scree::load<Wide>(state[Row::start_ratio]);
  const Wide ratio = before * (scree::load<Wide>(particles.growth) + 1.0);
  const Wide porosity = 1.0 - ((1 - pores.porosity) * start) / ratio;
  const Wide storage =
      porosity * (1 / pores.fluid_modulus) + (pores.biot - porosity) * pores.grain_compliance;
  const Wide space = ratio * flow.particle_volume, room = space * storage;
  const Wide missed = (ratio - before * (trace + 1.0)) * (pores.biot * flow.particle_volume);
  Wide k = broadcast<Wide>(pores.mobility);
  if (pores.kozeny_carman) {
    const Wide r = porosity / pores.porosity, s = (1 - pores.porosity) / (1.0 - porosity);
    k = k * (r * r * r * s * s);
  }
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) store(state[a * D + b], now[a][b]);
  }
  store(state[Row::ratio], ratio);
  store(value[3 * D], space);
  store(value[3 * D + 1], room);
  store(value[3 * D + 2], k);
  store(value[3 * D + 3], room * scree::load<Wide>(state[Row::base]));
  store(value[3 * D + 4], missed);
  const auto spot = order_.find(chunk, particles.position);
  double* field[fields] = {};
  for (std::size_t a = 0; a < D; ++a) {
    store(value[a], spot.local[a]);
    store(value[D + a], spot.xi[a]);
    field[a] = points.local[a].data();
    field[D + a] = points.xi[a].data();
    field[2 * D + a] = points.half[a].data();
  }
  field[3 * D] = points.volume.data();
  field[3 * D + 1] = points.capacity.data();
  field[3 * D + 2] = points.mobility.data();
  field[3 * D + 3] = points.content.data();
  field[3 * D + 4] = points.missed.data();
  for (int i = 0; i < particles.count; ++i) {
    const std::size_t p = std::size_t(order_.place(chunk, particles.first + i));
    SCREE_UNROLL for (int f = 0; f < fields; ++f) field[f][p] = value[f][i];
    points.place[p] = particles.place + i;
    point_of_[std::size_t(particles.place + i)] = std::int32_t(chunk.begin + std::int64_t(p));
  }
}

/// What the end of the step needs of a chunk's points.
template <int D>
void CoupledFlow<D>::keep(const FlowChunk<D>& chunk, const FlowPoints<D>& points) {
  const std::size_t count = std::size_t(chunk.end - chunk.begin), to = std::size_t(chunk.begin);
  for (std::size_t a = 0; a < D; ++a) {
    std::copy_n(points.xi[a].data(), count, points_.xi[a].data() + to);
  }
  std::copy_n(points.capacity.data(), count, points_.capacity.data() + to);
  std::copy_n(points.mobility.data(), count, points_.mobility.data() + to);
  std::copy_n(points.place.data(), count, points_.place.data() + to);
}

template <int D>
std::optional<SurfacePoint<D>> CoupledFlow<D>::surface_point(std::int64_t id) const {
  const std::int64_t place = states_.place(id);
  if (place < 0) return std::nullopt;
  const std::int64_t index = point_of_[std::size_t(place)];
  const auto after =
      std::upper_bound(chunks_.begin(), chunks_.end(), index,
                       [](std::int64_t p, const FlowChunk<D>& chunk) { return p < chunk.begin; });
  const FlowChunk<D>& chunk = *std::prev(after);
  SurfacePoint<D> point;
  for (const FlowRun<D>& run : chunk.runs) {
    const std::int64_t at = index - chunk.begin;
    if (at >= run.begin && at < run.end) point.cell = run.cell;
  }
  for (std::size_t a = 0; a < D; ++a) point.xi[a] = points_.xi[a][std::size_t(index)];
  point.mobility = points_.mobility[std::size_t(index)];
  point.fluid_density = bodies_[std::size_t(chunk.body)].pores->fluid_density;
  return point;
}

/// Pressure and seepage of the particles, where the stride ends or somebody looks.
template <int D>
void CoupledFlow<D>::end_step(const FlowStep<D>& step, bool ends, ThreadPool& pool) {
  auto start = Clock::now();
  missed_.advance(step.dt);
  surfaces_.add_outflow(matrix_, solution_, step.dt, outflow_);
  if (ends || step.record) {
    pool.for_each(std::int64_t(chunks_.size()), [&](std::int64_t c, int) {
      const FlowChunk<D>& chunk = chunks_[std::size_t(c)];
      for (const FlowRun<D>& run : chunk.runs) gather_run(step, ends, chunk, run);
    });
  }
  time_part(Part::points, start);
}

/// The pressures of the points from `first` on become those that the next ones begin with. What is
/// only looked at leaves no trace, whenever that may be.
template <int D>
void CoupledFlow<D>::settle(const double* pressure, std::int64_t first, int count) {
  using Row = PoreRow<D>;
  for (int i = 0; i < count; ++i) {
    const std::size_t p = std::size_t(first + i);
    auto& state = states_.vector(points_.place[p]).row;
    const int lane = int(points_.place[p] % PoreStates<D>::width);
    state[Row::stored][lane] += points_.capacity[p] * (pressure[i] - state[Row::base][lane]);
    state[Row::base][lane] = pressure[i];
  }
}

template <int D>
void CoupledFlow<D>::gather_run(const FlowStep<D>& step, bool ends, const FlowChunk<D>& chunk,
                                const FlowRun<D>& run) {
  constexpr int corners = 1 << D, width = lanes_of<Wide>;
  using Row = PoreRow<D>;
  const double density = bodies_[std::size_t(chunk.body)].pores->fluid_density;
  double nodal[corners];
  for (int k = 0; k < corners; ++k) {
    nodal[k] = solution_[std::size_t(matrix_.row(corner<D>(run.cell, k)))];
  }
  const std::int64_t end = chunk.begin + run.end;
  for (std::int64_t first = chunk.begin + run.begin; first < end; first += width) {
    const std::int64_t coming = std::min(first + 2 * width, end);
    for (std::int64_t p = std::min(first + width, coming); p < coming; ++p) {
      states_.prefetch_pressure(points_.place[std::size_t(p)]);
    }
    Wide hat[D][2], value, gradient[D];
    for (std::size_t a = 0; a < D; ++a) {
      hat[a][1] = load_any<Wide>(points_.xi[a].data() + first);
      hat[a][0] = 1.0 - hat[a][1];
    }
    interpolate<D>(nodal, hat, value, gradient);
    alignas(64) double pressure[width];
    store(pressure, value);
    const int count = int(std::min<std::int64_t>(width, end - first));
    if (ends) settle(pressure, first, count);
    for (int i = 0; i < count; ++i) {
      states_.at(points_.place[std::size_t(first + i)], Row::pressure) = pressure[i];
    }
    if (!step.record) continue;
    const Wide mobility = load_any<Wide>(points_.mobility.data() + first);
    for (std::size_t a = 0; a < D; ++a) {
      alignas(64) double seepage[width];
      store(seepage, -mobility * (gradient[a] * (1 / h_) - density * step.gravity[a]));
      for (int i = 0; i < count; ++i) {
        states_.at(points_.place[std::size_t(first + i)], Row::seepage + int(a)) = seepage[i];
      }
    }
  }
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
