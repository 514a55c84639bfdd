// SPDX-License-Identifier: Apache-2.0
// What the outside asks of the pore water, and its part of a checkpoint.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"

namespace scree {

template <int D>
std::array<double, 3> CoupledFlow<D>::seepage(std::int64_t id) const {
  std::array<double, 3> q{};
  for (std::size_t a = 0; a < D; ++a) q[a] = number(id, PoreRow<D>::seepage + int(a));
  return q;
}

/// The particle's own volume ratio, which may not be what its law sees.
template <int D>
double CoupledFlow<D>::own_ratio(std::int64_t id, double volume_ratio) const {
  if (!keeps_increments()) return volume_ratio;
  Mat3<double> f = identity3<double>();
  for (int i = 0; i < D * D; ++i) f(i / D, i % D) += own_[std::size_t(id)][std::size_t(i)];
  return number(id, PoreRow<D>::ratio) * det(f);
}

template <int D>
double CoupledFlow<D>::porosity(std::int32_t body, std::int64_t id, double volume_ratio) const {
  return porosity_at(*bodies_[std::size_t(body)].pores,
                     own_ratio(id, volume_ratio) / number(id, PoreRow<D>::start_ratio));
}

template <int D>
double CoupledFlow<D>::fluid_mass(std::int32_t body, std::int64_t id, double volume_ratio) const {
  const FlowBody& flow = bodies_[std::size_t(body)];
  if (!flow.pores) return 0;
  const double start = number(id, PoreRow<D>::start_ratio);
  const double change = flow.pores->biot * (own_ratio(id, volume_ratio) - start);
  return flow.pores->fluid_density *
         (flow.particle_volume * (start * flow.pores->porosity + change) + stored_volume(id));
}

/// Volume that compression has made room for up to the particle's latest pressure.
template <int D>
double CoupledFlow<D>::stored_volume(std::int64_t id) const {
  const double stored = number(id, PoreRow<D>::stored);
  const double change = number(id, PoreRow<D>::pressure) - number(id, PoreRow<D>::base);
  if (change == 0) return stored;
  const std::size_t point = std::size_t(point_of_[std::size_t(states_.place(id))]);
  return stored + points_.capacity[point] * change;
}

template <int D>
Lanes<double> CoupledFlow<D>::gained_mass(std::int32_t body, std::int64_t place) const {
  using Row = PoreRow<D>;
  const FlowBody& flow = bodies_[std::size_t(body)];
  const auto& state = states_.vector(place).row;
  const auto row = [&](int k) { return scree::load<Lanes<double>>(state[k]); };
  const Lanes<double> change = (row(Row::ratio) - row(Row::start_ratio)) * flow.pores->biot;
  return (change * flow.particle_volume + row(Row::stored)) * flow.pores->fluid_density;
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
std::vector<std::pair<std::string, double>> CoupledFlow<D>::times() const {
  const auto at = [this](Part part) { return seconds_[std::size_t(part)]; };
  return {{"pore_points", at(Part::points)},
          {"pore_constraints", at(Part::constraints)},
          {"pore_matrix", at(Part::matrix)},
          {"pore_solve", at(Part::solve)},
          {"pore_forces", at(Part::forces)}};
}

template <int D>
std::string CoupledFlow<D>::failure(double end, int halvings) const {
  const std::string halved =
      halvings == 0
          ? "coupling.halvings, which repeats such a step with half its length"
          : fmt::format("more coupling.halvings (the step was halved {} times)", halvings);
  return fmt::format(
      "pore pressure at t = {:.6g} s: the solver stopped after {} iterations with a relative "
      "residual of {:.3g} ({}); try coupling.preconditioner = \"icc\" or \"gamg\", a larger "
      "coupling.tolerance, a shorter time step, or {}",
      end, report_.iterations, report_.residual, report_.reason, halved);
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
  const std::size_t numbers = storage_.capacity() + conductance_.capacity() + schur_.capacity() +
                              solution_.capacity() + 3 * nodal_[0].capacity() + force_.capacity() +
                              D * D * own_.capacity();
  return std::int64_t(8 * numbers + 4 * point_of_.capacity()) + states_.bytes() + points_.bytes() +
         order_.bytes() + volume_.bytes() + cells_.bytes() + matrix_.bytes() + product_.bytes() +
         constraints_.bytes() + missed_.bytes();
}

namespace {

/// Numbers of a particle's pores in a checkpoint.
struct PoreArray {
  const char* name;
  int first, width;
};

template <int D>
constexpr std::array<PoreArray, 7> pore_arrays = {
    PoreArray{"coupling/pressure", PoreRow<D>::pressure, 1},
    PoreArray{"coupling/volume_ratio", PoreRow<D>::ratio, 1},
    PoreArray{"coupling/start_ratio", PoreRow<D>::start_ratio, 1},
    PoreArray{"coupling/stored", PoreRow<D>::stored, 1},
    PoreArray{"coupling/base_pressure", PoreRow<D>::base, 1},
    PoreArray{"coupling/seepage", PoreRow<D>::seepage, D},
    PoreArray{"coupling/deformation", PoreRow<D>::deformation, D* D}};

}  // namespace

/// By particle id; those that have no place have zeros.
template <int D>
void CoupledFlow<D>::save(StateWriter& writer) const {
  const std::int64_t particles = states_.particles();
  for (const PoreArray& array : pore_arrays<D>) {
    std::vector<double> values;
    values.reserve(std::size_t(particles) * std::size_t(array.width));
    for (std::int64_t id = 0; id < particles; ++id) {
      const std::int64_t place = states_.place(id);
      for (int a = 0; a < array.width; ++a) {
        values.push_back(place < 0 ? 0.0 : states_.at(place, array.first + a));
      }
    }
    writer.put(array.name, values);
  }
  std::vector<std::int32_t> present;
  for (std::int64_t id = 0; id < particles; ++id) present.push_back(states_.place(id) < 0 ? -1 : 1);
  writer.put("coupling/present", present);
  writer.put("coupling/water",
             std::vector<double>{start_mass_, left_, double(iterations_), double(halvings_)});
  writer.put("coupling/outflow", outflow_);
  if (keeps_increments()) {
    const double* numbers = own_.front().data();
    writer.put("coupling/increment", std::vector<double>(numbers, numbers + D * D * own_.size()));
  }
  save_nodes(writer);
}

/// What belongs to the nodes of the pressure: the solver starts from the first three.
template <int D>
template <class Self>
auto CoupledFlow<D>::nodal_fields(Self& self) {
  using Field =
      std::conditional_t<std::is_const_v<Self>, const std::vector<double>, std::vector<double>>;
  std::vector<std::pair<const char*, Field*>> fields = {
      {"coupling/nodal_pressure", &self.nodal_[0]},
      {"coupling/earlier_pressure", &self.nodal_[1]},
      {"coupling/earliest_pressure", &self.nodal_[2]}};
  if (self.missed_.spreads()) {
    fields.emplace_back("coupling/missed_foreseen", &self.missed_.foreseen());
    fields.emplace_back("coupling/missed_left", &self.missed_.left());
  }
  return fields;
}

template <int D>
void CoupledFlow<D>::save_nodes(StateWriter& writer) const {
  const auto fields = nodal_fields(*this);
  std::vector<std::int64_t> nodes;
  for (std::size_t n = 0; n < nodal_[0].size(); ++n) {
    const auto there = [n](const auto& field) { return (*field.second)[n] != 0; };
    if (std::any_of(fields.begin(), fields.end(), there)) nodes.push_back(std::int64_t(n));
  }
  writer.put("coupling/nodes", nodes);
  for (const auto& [name, field] : fields) {
    std::vector<double> values;
    for (const std::int64_t n : nodes) values.push_back((*field)[std::size_t(n)]);
    writer.put(name, values);
  }
  writer.put("coupling/missed_times", missed_.times());
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
  for (const auto& [name, field] : nodal_fields(*this)) {
    const auto values = reader.get<double>(name);
    if (values.size() != nodes.size()) return false;
    field->assign(field->size(), 0.0);
    for (std::size_t n = 0; n < nodes.size(); ++n) (*field)[std::size_t(nodes[n])] = values[n];
  }
  missed_.resume(reader.get<double>("coupling/missed_times"));
  return true;
}

/// False: the numbers do not match.
template <int D>
bool CoupledFlow<D>::load_pores(const StateReader& reader) {
  const std::int64_t particles = states_.particles();
  for (const PoreArray& array : pore_arrays<D>) {
    const auto values = reader.get<double>(array.name);
    if (std::int64_t(values.size()) != particles * array.width) return false;
    for (std::int64_t id = 0; id < particles; ++id) {
      const std::int64_t place = states_.place(id);
      for (int a = 0; a < array.width && place >= 0; ++a) {
        states_.at(place, array.first + a) = values[std::size_t(id * array.width + a)];
      }
    }
  }
  const auto present = reader.get<std::int32_t>("coupling/present");
  if (std::int64_t(present.size()) != particles) return false;
  for (std::int64_t id = 0; id < particles; ++id) {
    if (present[std::size_t(id)] < 0) states_.forget(id);
  }
  return true;
}

template <int D>
void CoupledFlow<D>::load(const StateReader& reader) {
  bool fits = load_pores(reader);
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
  if (!load_nodes(reader) || !fits || outflow_.size() != surfaces) {
    throw RunFault("the checkpoint's pore water does not match this deck");
  }
}

template class CoupledFlow<2>;
template class CoupledFlow<3>;

}  // namespace scree
