// SPDX-License-Identifier: Apache-2.0
// The particles' part in the step of the pore water.
#include <algorithm>
#include <cmath>

#include "solver/coupling/coupled_flow.hpp"

namespace scree {

template <int D>
Mat3<double> CoupledFlow<D>::deformation(std::int64_t id) const {
  Mat3<double> f = identity3<double>();
  for (int i = 0; i < D * D; ++i) {
    f(i / D, i % D) = state_[std::size_t(id)].deformation[i];
  }
  return f;
}

template <int D>
void CoupledFlow<D>::fill(std::int64_t point, std::int32_t body, const Mat3<double>& increment) {
  const std::size_t i = std::size_t(point);
  const std::int64_t id = points_.id[i];
  const FlowBody& flow = bodies_[std::size_t(body)];
  const PoreSetup& pores = *flow.pores;
  PoreState<D>& state = state_[std::size_t(id)];
  Mat3<double> f = identity3<double>() + increment;
  const double before = state.ratio;
  state.ratio = before * det(f);
  const double linear = before * (1 + increment(0, 0) + increment(1, 1) + increment(2, 2));
  const Mat3<double> total = f * deformation(id);
  const double half = half_side_[std::size_t(body)] / h_;
  for (int a = 0; a < D; ++a) {
    double square = 0;
    for (int b = 0; b < D; ++b) {
      square += total(a, b) * total(a, b);
      state.deformation[a * D + b] = total(a, b);
    }
    points_.half[std::size_t(a)][i] = half * std::min(std::sqrt(square), longest_box);
  }
  const double porosity = porosity_at(pores, state.ratio / state.start_ratio);
  const double volume = flow.particle_volume * state.ratio;
  const double capacity = volume * storage_at(pores, porosity);
  points_.volume[i] = volume;
  points_.capacity[i] = capacity;
  points_.mobility[i] = mobility_at(pores, porosity);
  points_.content[i] =
      capacity * state.pressure - pores.biot * flow.particle_volume * (state.ratio - linear);
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
  const double density = bodies_[std::size_t(body)].pores->fluid_density;
  double nodal[corners];
  for (int k = 0; k < corners; ++k) {
    nodal[k] = solution_[std::size_t(matrix_.row(corner<D>(run.cell, k)))];
  }
  for (std::size_t i = std::size_t(run.begin); i < std::size_t(run.end); ++i) {
    double xi[D], n[corners], slope[corners][D], value = 0, gradient[D] = {};
    for (std::size_t a = 0; a < D; ++a) xi[a] = points_.xi[a][i];
    hats<D>(xi, n);
    hat_slopes<D>(xi, slope);
    for (int k = 0; k < corners; ++k) {
      value += n[k] * nodal[k];
      for (int a = 0; a < D; ++a) gradient[a] += slope[k][a] * nodal[k];
    }
    PoreState<D>& state = state_[std::size_t(points_.id[i])];
    state.stored += points_.capacity[i] * (value - state.pressure);
    state.pressure = value;
    for (int a = 0; a < D; ++a) {
      state.seepage[a] =
          -points_.mobility[i] * (gradient[a] / h_ - density * gravity[std::size_t(a)]);
    }
  }
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
