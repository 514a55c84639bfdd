// SPDX-License-Identifier: Apache-2.0
// What the outside asks of the pore water, and its part of a checkpoint.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"

namespace scree {

template <int D>
std::array<double, 3> CoupledFlow<D>::seepage(std::int64_t id) const {
  std::array<double, 3> q{};
  for (std::size_t a = 0; a < D; ++a) q[a] = state_[std::size_t(id)].seepage[a];
  return q;
}

/// The particle's own volume ratio, which may not be what its law sees.
template <int D>
double CoupledFlow<D>::own_ratio(std::int64_t id, double volume_ratio) const {
  if (!keeps_increments()) return volume_ratio;
  Mat3<double> f = identity3<double>();
  for (int i = 0; i < D * D; ++i) f(i / D, i % D) += own_[std::size_t(id)][std::size_t(i)];
  return state_[std::size_t(id)].ratio * det(f);
}

template <int D>
double CoupledFlow<D>::porosity(std::int32_t body, std::int64_t id, double volume_ratio) const {
  return porosity_at(*bodies_[std::size_t(body)].pores,
                     own_ratio(id, volume_ratio) / state_[std::size_t(id)].start_ratio);
}

template <int D>
double CoupledFlow<D>::fluid_mass(std::int32_t body, std::int64_t id, double volume_ratio) const {
  const FlowBody& flow = bodies_[std::size_t(body)];
  if (!flow.pores) return 0;
  const double start = state_[std::size_t(id)].start_ratio;
  const double change = flow.pores->biot * (own_ratio(id, volume_ratio) - start);
  return flow.pores->fluid_density *
         (flow.particle_volume * (start * flow.pores->porosity + change) +
          state_[std::size_t(id)].stored);
}

/// Not inlined: it must round alike in a run and after a restart.
template <int D>
[[gnu::noinline]] double CoupledFlow<D>::gain(const FlowBody& body, const PoreState<D>& state) {
  const double change = body.pores->biot * (state.ratio - state.start_ratio);
  return body.pores->fluid_density * (body.particle_volume * change + state.stored);
}

template <int D>
FluidBalance CoupledFlow<D>::balance(double mass) const {
  FluidBalance balance;
  balance.mass = mass;
  balance.surfaces = outflow_;
  balance.outflow = left_;
  for (const double through : outflow_) balance.outflow += through;
  balance.error = start_mass_ > 0 ? (mass + balance.outflow - start_mass_) / start_mass_ : 0;
  balance.iterations = iterations_;
  balance.halvings = halvings_;
  return balance;
}

template <int D>
GridSnapshot CoupledFlow<D>::grid() const {
  GridSnapshot out;
  out.lattice = "pressure";
  out.spacing = h_;
  PressureNode<D> first{};
  std::int64_t total = 1;
  for (std::size_t a = 0; a < D; ++a) {
    first[a] = std::int32_t(std::floor(lattice_.coordinate(0)));
    const auto last = std::int32_t(std::ceil(lattice_.coordinate(domain_.cells[a])));
    out.nodes[a] = last - first[a] + 1;
    out.origin[a] = domain_.lower[a] + h_ * first[a] + domain_.cell_size * lattice_.offset();
    total *= out.nodes[a];
  }
  std::vector<double> values(std::size_t(total), std::numeric_limits<double>::quiet_NaN());
  for (std::int64_t i = 0; i < total && matrix_.rows() > 0; ++i) {
    PressureNode<D> node = first;
    std::int64_t rest = i;
    for (std::size_t a = 0; a < D; ++a) {
      node[a] += std::int32_t(rest % out.nodes[a]);
      rest /= out.nodes[a];
    }
    const std::int32_t row = matrix_.row(node);
    if (row >= 0) values[std::size_t(i)] = solution_[std::size_t(row)];
  }
  out.fields.push_back({"pore_pressure", "Pa", 1, std::move(values)});
  return out;
}

template <int D>
std::int64_t CoupledFlow<D>::bytes() const {
  const std::size_t numbers = solution_.capacity() + 3 * nodal_[0].capacity() + force_.capacity() +
                              gained_.capacity() + D * D * own_.capacity();
  return std::int64_t(8 * numbers + 4 * point_of_.capacity() +
                      sizeof(PoreState<D>) * state_.capacity()) +
         points_.bytes() + volume_.bytes() + cells_.bytes() + matrix_.bytes() + product_.bytes();
}

namespace {

/// Numbers that all particles have, as arrays by particle.
template <int D, class State, class F>
void each_array(State& state, F&& f) {
  f(
      "coupling/pressure", 1, [&](std::size_t i, int) -> auto& { return state[i].pressure; });
  f(
      "coupling/volume_ratio", 1, [&](std::size_t i, int) -> auto& { return state[i].ratio; });
  f(
      "coupling/start_ratio", 1, [&](std::size_t i, int) -> auto& { return state[i].start_ratio; });
  f(
      "coupling/stored", 1, [&](std::size_t i, int) -> auto& { return state[i].stored; });
  f(
      "coupling/seepage", D, [&](std::size_t i, int a) -> auto& { return state[i].seepage[a]; });
  f(
      "coupling/deformation",
      D * D, [&](std::size_t i, int a) -> auto& { return state[i].deformation[a]; });
}

}  // namespace

template <int D>
void CoupledFlow<D>::save(StateWriter& writer) const {
  each_array<D>(state_, [&](const char* name, int width, auto&& at) {
    std::vector<double> values;
    values.reserve(state_.size() * std::size_t(width));
    for (std::size_t i = 0; i < state_.size(); ++i) {
      for (int a = 0; a < width; ++a) values.push_back(at(i, a));
    }
    writer.put(name, values);
  });
  writer.put("coupling/water",
             std::vector<double>{start_mass_, left_, double(iterations_), double(halvings_)});
  writer.put("coupling/outflow", outflow_);
  std::vector<std::int32_t> alive;
  for (const std::int32_t point : point_of_) alive.push_back(point >= 0 ? 1 : -1);
  writer.put("coupling/present", alive);
  if (keeps_increments()) {
    const double* numbers = own_.front().data();
    writer.put("coupling/increment", std::vector<double>(numbers, numbers + D * D * own_.size()));
  }
  save_nodes(writer);
}

constexpr std::array<const char*, 3> nodal_names = {
    "coupling/nodal_pressure", "coupling/earlier_pressure", "coupling/earliest_pressure"};

/// The solver starts from these, so they belong to the state.
template <int D>
void CoupledFlow<D>::save_nodes(StateWriter& writer) const {
  std::vector<std::int64_t> nodes;
  for (std::size_t n = 0; n < nodal_[0].size(); ++n) {
    if (nodal_[0][n] != 0 || nodal_[1][n] != 0 || nodal_[2][n] != 0)
      nodes.push_back(std::int64_t(n));
  }
  writer.put("coupling/nodes", nodes);
  for (std::size_t k = 0; k < nodal_.size(); ++k) {
    std::vector<double> values;
    for (const std::int64_t n : nodes) values.push_back(nodal_[k][std::size_t(n)]);
    writer.put(nodal_names[k], values);
  }
}

/// False: the numbers do not match.
template <int D>
bool CoupledFlow<D>::load_nodes(const StateReader& reader) {
  const auto nodes = reader.get<std::int64_t>("coupling/nodes");
  const auto known = std::int64_t(nodal_[0].size());
  if (std::any_of(nodes.begin(), nodes.end(),
                  [&](std::int64_t n) { return n < 0 || n >= known; })) {
    return false;
  }
  for (std::size_t k = 0; k < nodal_.size(); ++k) {
    const auto values = reader.get<double>(nodal_names[k]);
    if (values.size() != nodes.size()) return false;
    nodal_[k].assign(nodal_[k].size(), 0.0);
    for (std::size_t n = 0; n < nodes.size(); ++n) nodal_[k][std::size_t(nodes[n])] = values[n];
  }
  return true;
}

template <int D>
void CoupledFlow<D>::update_gains() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::size_t begin = std::size_t(bodies_[b].first_id);
    const std::size_t end =
        b + 1 < bodies_.size() ? std::size_t(bodies_[b + 1].first_id) : state_.size();
    for (std::size_t id = begin; id < end && bodies_[b].pores; ++id) {
      gained_[id] = gain(bodies_[b], state_[id]);
    }
  }
}

template <int D>
void CoupledFlow<D>::load(const StateReader& reader) {
  bool fits = true;
  each_array<D>(state_, [&](const char* name, int width, auto&& at) {
    const auto values = reader.get<double>(name);
    if (values.size() != state_.size() * std::size_t(width)) {
      fits = false;
      return;
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      for (int a = 0; a < width; ++a) at(i, a) = values[next++];
    }
  });
  point_of_ = reader.get<std::int32_t>("coupling/present");
  present_ = -1;
  auto water = reader.get<double>("coupling/water");
  fits = fits && water.size() == 4;
  water.resize(4);
  start_mass_ = water.at(0);
  left_ = water.at(1);
  const std::size_t surfaces = outflow_.size();
  outflow_ = reader.get<double>("coupling/outflow");
  iterations_ = int(water.at(2));
  halvings_ = std::int64_t(water.at(3));
  if (keeps_increments()) {
    const auto increments = reader.get<double>("coupling/increment");
    fits = fits && increments.size() == own_.size() * D * D;
    if (fits) std::copy(increments.begin(), increments.end(), own_.front().data());
  }
  if (!load_nodes(reader) || !fits || point_of_.size() != state_.size() ||
      outflow_.size() != surfaces) {
    throw RunFault("the checkpoint's pore water does not match this deck");
  }
  update_gains();
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
