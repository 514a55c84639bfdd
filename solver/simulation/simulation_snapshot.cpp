// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "solver/base/error.hpp"
#include "solver/simulation/particle_view.hpp"
#include "solver/simulation/simulation_impl.hpp"
#include "solver/simulation/visit_block.hpp"

namespace scree {
namespace {

constexpr int sym_index[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};

struct BuiltInField {
  const char* name;
  const char* unit;
  int components;
};

constexpr BuiltInField built_in_fields[] = {
    {"velocity", "m/s", 3}, {"stress", "Pa", 9},  {"pressure", "Pa", 1},
    {"mass", "kg", 1},      {"volume", "m^3", 1}, {"displacement", "m", 3},
};

const BuiltInField* find_built_in(const std::string& name) {
  for (const BuiltInField& field : built_in_fields) {
    if (name == field.name) return &field;
  }
  return nullptr;
}

/// Cauchy stress is Kirchhoff stress over J; pressure is compression positive.
void write_built_in(const std::string& name, const ParticleView& p, const BodyInfo& info,
                    const double* reference, double* out) {
  if (name == "velocity") {
    std::copy(p.velocity.begin(), p.velocity.end(), out);
  } else if (name == "stress") {
    for (int i = 0; i < 9; ++i) out[i] = p.kirchhoff[std::size_t(sym_index[i])] / p.volume_ratio;
  } else if (name == "pressure") {
    out[0] = -(p.kirchhoff[0] + p.kirchhoff[3] + p.kirchhoff[5]) / (3 * p.volume_ratio);
  } else if (name == "mass") {
    out[0] = info.particle_mass();
  } else if (name == "volume") {
    out[0] = info.particle_volume * p.volume_ratio;
  } else if (name == "displacement") {
    for (int a = 0; a < 3; ++a) out[a] = p.position[std::size_t(a)] - reference[a];
  }
}

}  // namespace

template <int D, class T>
ParticleSnapshot SimulationImpl<D, T>::particles(const std::vector<std::string>& fields) const {
  require_record("particles");
  ParticleSnapshot out;
  out.time = clock_.time;
  out.step = step_;
  out.dimension = D;
  // Rows in the order of ids: particles that left make gaps, which the ranks close.
  std::vector<std::int64_t> ids;
  for (const State& state : bodies_) {
    for (std::size_t b = 0; b < state.body->store().blocks().size(); ++b) {
      visit_block(state, b, [&](const ParticleView& p) { ids.push_back(p.id); });
    }
  }
  std::sort(ids.begin(), ids.end());
  const std::size_t n = ids.size();
  out.position.resize(3 * n);
  out.material.resize(n);
  out.body.resize(n);
  for (const State& state : bodies_) {
    for (std::size_t b = 0; b < state.body->store().blocks().size(); ++b) {
      visit_block(state, b, [&](const ParticleView& p) {
        const std::size_t row =
            std::size_t(std::lower_bound(ids.begin(), ids.end(), p.id) - ids.begin());
        for (int a = 0; a < 3; ++a) out.position[3 * row + a] = p.position[std::size_t(a)];
        out.material[row] = state.body->info().material_index;
        out.body[row] = state.body->info().body_index;
      });
    }
  }
  out.id = std::move(ids);
  for (const std::string& name : fields) fill_field(out, name);
  return out;
}

/// A body whose material lacks the field gets NaN: nothing is made up for it.
template <int D, class T>
void SimulationImpl<D, T>::fill_field(ParticleSnapshot& out, const std::string& name) const {
  SnapshotField field;
  field.name = name;
  field.components = 0;
  const BuiltInField* built_in = find_built_in(name);
  if (built_in != nullptr) {
    field.unit = built_in->unit;
    field.components = built_in->components;
  }
  for (const State& state : bodies_) {
    for (const StateColumn& column : state.body->columns()) {
      if (built_in != nullptr || column.name != name) continue;
      field.unit = column.unit;
      field.components = column.components;
    }
  }
  if (field.components == 0) throw UserError("there is no output field \"" + name + "\"");
  const std::size_t width = std::size_t(field.components);
  field.values.assign(out.id.size() * width, std::numeric_limits<double>::quiet_NaN());
  for (const State& state : bodies_) {
    const StateColumn* column = nullptr;
    for (const StateColumn& c : state.body->columns()) {
      if (c.name == name) column = &c;
    }
    if (built_in == nullptr && column == nullptr) continue;
    const ParticleStore<D, T>& store = state.body->store();
    for (std::size_t b = 0; b < store.blocks().size(); ++b) {
      visit_block(state, b, [&](const ParticleView& p) {
        const auto it = std::lower_bound(out.id.begin(), out.id.end(), p.id);
        double* value = &field.values[std::size_t(it - out.id.begin()) * width];
        if (built_in != nullptr) {
          const std::size_t at = reference_.empty() ? 0 : 3 * std::size_t(p.id);
          write_built_in(name, p, state.body->info(), reference_.data() + at, value);
          return;
        }
        const T* batch = store.batch(p.batch);
        for (std::size_t c = 0; c < width; ++c) {
          const std::size_t entry = std::size_t(D + column->first) + c;
          value[c] = double(batch[entry * ParticleStore<D, T>::width + std::size_t(p.lane)]);
        }
      });
    }
  }
  out.fields.push_back(std::move(field));
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
