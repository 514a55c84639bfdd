// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "solver/base/error.hpp"
#include "solver/simulation/particle_view.hpp"
#include "solver/simulation/simulation_impl.hpp"
#include "solver/simulation/visit_block.hpp"

namespace scree {
namespace {

/// Where the components of a 3x3 tensor, row-major, lie among xx, xy, xz, yy, yz, zz. Viewers order
/// six components otherwise, so all tensors go out whole.
constexpr int sym_index[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};

}  // namespace

enum class FieldQuantity {
  velocity,
  stress,
  effective_stress,
  pressure,
  mass,
  volume,
  displacement,
  pore_pressure,
  porosity,
  seepage_velocity,
  state
};

/// Where a field's values come from.
struct FieldSource {
  FieldQuantity quantity = FieldQuantity::state;
  std::vector<int> first;  ///< state: per body, first entry of the column; -1 = the body has none
  bool symmetric = false;  ///< state: six entries that go out as nine components
};

namespace {

struct BuiltInField {
  const char* name;
  const char* unit;
  int components;
  FieldQuantity quantity;
};

constexpr BuiltInField built_in_fields[] = {
    {"velocity", "m/s", 3, FieldQuantity::velocity},
    {"stress", "Pa", 9, FieldQuantity::stress},
    {"effective_stress", "Pa", 9, FieldQuantity::effective_stress},
    {"pressure", "Pa", 1, FieldQuantity::pressure},
    {"mass", "kg", 1, FieldQuantity::mass},
    {"volume", "m^3", 1, FieldQuantity::volume},
    {"displacement", "m", 3, FieldQuantity::displacement},
    {"pore_pressure", "Pa", 1, FieldQuantity::pore_pressure},
    {"porosity", "", 1, FieldQuantity::porosity},
    {"seepage_velocity", "m/s", 3, FieldQuantity::seepage_velocity},
};

/// Cauchy stress is Kirchhoff stress over J, total where there is pore water; pressure is that of
/// the same stress, compression positive.
void write_built_in(FieldQuantity quantity, const ParticleView& p, const BodyInfo& info,
                    const double* reference, double* out) {
  switch (quantity) {
    case FieldQuantity::velocity:
      std::copy(p.velocity.begin(), p.velocity.end(), out);
      return;
    case FieldQuantity::stress:
      for (int i = 0; i < 9; ++i) out[i] = p.kirchhoff[std::size_t(sym_index[i])] / p.volume_ratio;
      return;
    case FieldQuantity::effective_stress:
      if (!p.pore_pressure) return;  // no pore water: stays NaN
      for (int i = 0; i < 9; ++i) {
        out[i] = p.kirchhoff[std::size_t(sym_index[i])] / p.volume_ratio;
        if (i % 4 == 0) out[i] += p.biot * *p.pore_pressure;
      }
      return;
    case FieldQuantity::pressure:
      out[0] = -(p.kirchhoff[0] + p.kirchhoff[3] + p.kirchhoff[5]) / (3 * p.volume_ratio);
      return;
    case FieldQuantity::mass:
      out[0] = info.particle_mass();
      return;
    case FieldQuantity::volume:
      out[0] = info.particle_volume * p.volume_ratio;
      return;
    case FieldQuantity::displacement:
      for (int a = 0; a < 3; ++a) out[a] = p.position[std::size_t(a)] - reference[a];
      return;
    case FieldQuantity::pore_pressure:
      if (p.pore_pressure) out[0] = *p.pore_pressure;
      return;
    case FieldQuantity::porosity:
      if (p.porosity) out[0] = *p.porosity;
      return;
    case FieldQuantity::seepage_velocity:
      if (p.porosity) std::copy(p.seepage.begin(), p.seepage.end(), out);
      return;
    case FieldQuantity::state:
      return;
  }
}

/// The field `name`, empty, and where its values come from. Throws UserError for an unknown name.
template <int D, class T>
FieldSource find_field(const std::vector<BodyState<D, T>>& bodies, const std::string& name,
                       SnapshotField& field) {
  FieldSource source;
  field.name = name;
  for (const BuiltInField& known : built_in_fields) {
    if (name != known.name) continue;
    field.unit = known.unit;
    field.components = known.components;
    source.quantity = known.quantity;
    return source;
  }
  field.components = 0;
  for (const BodyState<D, T>& state : bodies) {
    source.first.push_back(-1);
    for (const StateColumn& column : state.body->columns()) {
      if (column.name != name) continue;
      field.unit = column.unit;
      source.symmetric = column.components == 6;
      field.components = source.symmetric ? 9 : column.components;
      source.first.back() = column.first;
    }
  }
  if (field.components == 0) throw UserError("there is no output field \"" + name + "\"");
  return source;
}

/// f(id) for every living particle.
template <int D, class T, class F>
void each_id(const std::vector<BodyState<D, T>>& bodies, F&& f) {
  constexpr int width = ParticleStore<D, T>::width;
  for (const BodyState<D, T>& state : bodies) {
    const ParticleStore<D, T>& store = state.body->store();
    for (const auto& block : store.blocks()) {
      for (int i = 0; i < block.count; ++i) {
        const std::int64_t id = store.ids(block.batches[std::size_t(i / width)])[i % width];
        if (id >= 0) f(id);
      }
    }
  }
}

/// Row of each id among the living particles, -1 for those that left; ids: those that live, in
/// order. Ids are small numbers, so they are counted, not sorted.
template <int D, class T>
std::vector<std::int64_t> rows_by_id(const std::vector<BodyState<D, T>>& bodies,
                                     std::vector<std::int64_t>& ids) {
  std::int64_t last = -1;
  each_id(bodies, [&](std::int64_t id) { last = std::max(last, id); });
  std::vector<std::int64_t> rows(std::size_t(last + 1), -1);
  each_id(bodies, [&](std::int64_t id) { rows[std::size_t(id)] = 0; });
  for (std::size_t id = 0; id < rows.size(); ++id) {
    if (rows[id] < 0) continue;
    rows[id] = std::int64_t(ids.size());
    ids.push_back(std::int64_t(id));
  }
  return rows;
}

/// What every snapshot holds by itself.
bool always_there(const std::string& name) {
  return name == "id" || name == "material" || name == "body";
}

}  // namespace

/// A body whose material lacks a field gets NaN there: nothing is made up for it.
template <int D, class T>
ParticleSnapshot SimulationImpl<D, T>::particles(const std::vector<std::string>& fields) const {
  require_record("particles");
  ParticleSnapshot out;
  out.time = clock_.time;
  out.step = step_;
  out.dimension = D;
  const std::vector<std::int64_t> rows = rows_by_id(bodies_, out.id);
  const std::size_t n = out.id.size();
  out.position.resize(3 * n);
  out.material.resize(n);
  out.body.resize(n);
  std::vector<FieldSource> sources;
  for (const std::string& name : fields) {
    if (always_there(name)) continue;
    out.fields.emplace_back();
    sources.push_back(find_field(bodies_, name, out.fields.back()));
    out.fields.back().values.assign(n * std::size_t(out.fields.back().components),
                                    std::numeric_limits<double>::quiet_NaN());
  }
  for (const State& state : bodies_) {
    const auto write = [&](const ParticleView& view) {
      write_row(view, state, sources, std::size_t(rows[std::size_t(view.id)]), out);
    };
    executor_.pool().for_each(
        std::int64_t(state.body->store().blocks().size()),
        [&](std::int64_t b, int) { visit_block(state, std::size_t(b), write); }, 4);
  }
  return out;
}

/// One particle's position, body and fields.
template <int D, class T>
void SimulationImpl<D, T>::write_row(const ParticleView& particle, const State& state,
                                     const std::vector<FieldSource>& sources, std::size_t row,
                                     ParticleSnapshot& out) const {
  const BodyInfo& info = state.body->info();
  std::copy(particle.position.begin(), particle.position.end(), &out.position[3 * row]);
  out.material[row] = info.material_index;
  out.body[row] = info.body_index;
  const std::size_t id = std::size_t(particle.id);
  const double* reference = reference_.empty() ? nullptr : &reference_[3 * id];
  const T* record = state.body->store().batch(particle.batch) + particle.lane;
  for (std::size_t f = 0; f < sources.size(); ++f) {
    const FieldSource& source = sources[f];
    const std::size_t components = std::size_t(out.fields[f].components);
    double* value = &out.fields[f].values[row * components];
    write_built_in(source.quantity, particle, info, reference, value);
    if (source.quantity != FieldQuantity::state) continue;
    const int first = source.first[std::size_t(info.body_index)];
    if (first < 0) continue;
    for (std::size_t c = 0; c < components; ++c) {
      const int entry = first + (source.symmetric ? sym_index[c] : int(c));
      value[c] = double(record[std::size_t(D + entry) * ParticleStore<D, T>::width]);
    }
  }
}

template <int D, class T>
std::vector<GridSnapshot> SimulationImpl<D, T>::grid() const {
  std::vector<GridSnapshot> out;
  for (int lattice = 0; lattice < grid_.lattices(); ++lattice) {
    GridSnapshot snapshot;
    snapshot.time = clock_.time;
    snapshot.step = step_;
    snapshot.lattice = grid_.lattices() == 1 ? "nodes" : lattice == 0 ? "minus" : "plus";
    snapshot.spacing = setup_.cell_size;
    std::int64_t total = 1;
    for (int a = 0; a < D; ++a) {
      snapshot.origin[a] = setup_.lower[std::size_t(a)] + 0.5 * lattice * setup_.cell_size;
      snapshot.nodes[a] = domain_.cells[a] + 1 - lattice;
      total *= snapshot.nodes[a];
    }
    SnapshotField mass{"mass", "kg", 1, std::vector<double>(std::size_t(total), 0.0)};
    SnapshotField velocity{"velocity", "m/s", 3, std::vector<double>(3 * std::size_t(total), 0.0)};
    fill_lattice(snapshot, lattice, mass.values, velocity.values);
    snapshot.fields = {std::move(mass), std::move(velocity)};
    out.push_back(std::move(snapshot));
  }
  return out;
}

/// Values of the nodes inside the domain; nodes of blocks that are not active stay zero.
template <int D, class T>
void SimulationImpl<D, T>::fill_lattice(const GridSnapshot& snapshot, int lattice,
                                        std::vector<double>& mass,
                                        std::vector<double>& velocity) const {
  const AlignedVector<T>& channel = velocity_channel();
  if (channel.size() != grid_.size()) return;
  for (int b = 0; b < grid_.topology().size(); ++b) {
    for (int n = 0; n < block_node_count<D>; ++n) {
      const BlockCoord<D> node = grid_.node(b, n);
      std::int64_t at = 0;
      bool inside = true;
      for (int a = D - 1; a >= 0; --a) {
        inside = inside && node[a] >= 0 && node[a] < snapshot.nodes[a];
        at = at * snapshot.nodes[a] + node[a];
      }
      if (!inside) continue;
      const std::size_t record =
          (std::size_t(b) * std::size_t(grid_.lattices()) + std::size_t(lattice)) *
              block_node_count<D> +
          std::size_t(n);
      const T* values = channel.data() + record * node_values;
      mass[std::size_t(at)] = double(values[mass_slot]);
      for (int a = 0; a < D; ++a) velocity[3 * std::size_t(at) + a] = double(values[a]);
    }
  }
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
