// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/material_point.hpp"
#include "materials/registry.hpp"
#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"
#include "solver/simulation/particle_values.hpp"
#include "solver/simulation/particle_view.hpp"
#include "solver/simulation/simulation_impl.hpp"
#include "solver/simulation/visit_block.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {

/// Where a field's values come from.
struct FieldSource {
  FieldQuantity quantity = FieldQuantity::state;
  /// Of the material's state: per body, first entry of the column; -1 = the body has none.
  std::vector<int> first;
  bool symmetric = false;  ///< six entries that go out as nine components
};

namespace {

/// Finds the column `name` in each body's state. False if no body has it.
template <int D, class T>
bool find_column(const std::vector<BodyState<D, T>>& bodies, const std::string& name,
                 FieldSource& source, SnapshotField& field) {
  bool found = false;
  for (const BodyState<D, T>& state : bodies) {
    source.first.push_back(-1);
    for (const StateColumn& column : state.body->columns()) {
      if (column.name != name) continue;
      found = true;
      field.unit = column.unit;
      source.symmetric = column.components == 6;
      field.components = source.symmetric ? 9 : column.components;
      source.first.back() = column.first;
    }
  }
  return found;
}

/// The field `name`, empty, and where its values come from. Throws UserError for an unknown name.
template <int D, class T>
FieldSource find_field(const std::vector<BodyState<D, T>>& bodies, const std::string& name,
                       SnapshotField& field) {
  FieldSource source;
  field.name = name;
  for (const ParticleField& known : particle_fields()) {
    if (name != known.name) continue;
    source.quantity = known.quantity;
    if (known.quantity == FieldQuantity::equivalent_plastic_shear_strain) {
      find_column(bodies, "equivalent_plastic_strain", source, field);
    }
    field.unit = known.unit;
    field.components = known.components;
    return source;
  }
  if (find_column(bodies, name, source, field)) return source;
  throw UserError("there is no output field \"" + name + "\"");
}

/// f(id, body, block, batch, lane) for every living particle.
template <int D, class T, class F>
void each_particle(const std::vector<BodyState<D, T>>& bodies, F&& f) {
  constexpr int width = ParticleStore<D, T>::width;
  for (const BodyState<D, T>& state : bodies) {
    const ParticleStore<D, T>& store = state.body->store();
    for (const auto& block : store.blocks()) {
      for (int i = 0; i < block.count; ++i) {
        const std::int32_t batch = block.batches[std::size_t(i / width)];
        const std::int64_t id = store.ids(batch)[i % width];
        if (id >= 0) f(id, store, block.key, batch, i % width);
      }
    }
  }
}

/// What every snapshot holds by itself.
bool always_there(const std::string& name) {
  return name == "id" || name == "material" || name == "body";
}

/// Rows of the chosen ids in `rows` (-1: none, else anything), by rising id; ids: those chosen. Ids
/// are small numbers, so they are counted, not sorted.
std::vector<std::int64_t> number_rows(std::vector<std::int64_t>& rows) {
  std::vector<std::int64_t> ids;
  for (std::size_t id = 0; id < rows.size(); ++id) {
    if (rows[id] < 0) continue;
    rows[id] = std::int64_t(ids.size());
    ids.push_back(std::int64_t(id));
  }
  return ids;
}

/// M D^-1 of a kernel for a particle at u [cells].
template <class Kernel, int D>
void times_inverse_moment(const double (&u)[D], const double (&m)[D][D], double (&out)[D][D]) {
  Kernel::template times_inverse_moment<double, D>(Kernel::template at<double, D>(u), m, out);
}

}  // namespace

/// Row of each id among the living particles that the filter takes, -1 for all others.
template <int D, class T>
std::vector<std::int64_t> SimulationImpl<D, T>::choose(const ParticleFilter& filter) const {
  std::int64_t last = -1;
  each_particle(bodies_, [&](std::int64_t id, const auto&...) { last = std::max(last, id); });
  std::vector<std::int64_t> rows(std::size_t(last + 1), -1);
  each_particle(bodies_, [&](std::int64_t id, const auto& store, std::uint64_t key,
                             std::int32_t batch, int lane) {
    if (filter && !filter(id, position_of(key, store, batch, lane).data())) return;
    rows[std::size_t(id)] = 0;
  });
  return rows;
}

/// A body whose material lacks a field gets NaN there: nothing is made up for it.
template <int D, class T>
ParticleSnapshot SimulationImpl<D, T>::particles(const std::vector<std::string>& fields,
                                                 const ParticleFilter& filter) const {
  require_record("particles");
  backend_->give_particles();
  ParticleSnapshot out;
  out.time = clock_.time;
  out.step = step_;
  out.dimension = D;
  std::vector<std::int64_t> rows = choose(filter);
  out.id = number_rows(rows);
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
    executor_.pool().for_each(
        std::int64_t(state.body->store().blocks().size()),
        [&](std::int64_t b, int) {
          std::unique_ptr<MaterialPoint> point;  // one law at a time: it holds a state
          visit_block(state, std::size_t(b), [&](const ParticleView& view) {
            const std::int64_t row = rows[std::size_t(view.id)];
            if (row >= 0) write_row(view, state, sources, std::size_t(row), point, out);
          });
        },
        4);
  }
  return out;
}

/// One particle's position, body and fields.
template <int D, class T>
void SimulationImpl<D, T>::write_row(const ParticleView& particle, const State& state,
                                     const std::vector<FieldSource>& sources, std::size_t row,
                                     std::unique_ptr<MaterialPoint>& point,
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
    write_quantity(source.quantity, particle, info, reference, value);
    if (source.quantity == FieldQuantity::strain_rate) write_strain_rate(particle, state, value);
    if (source.quantity == FieldQuantity::yield_distance) {
      value[0] = yield_distance(particle, state, point);
    }
    const int first = source.first.empty() ? -1 : source.first[std::size_t(info.body_index)];
    if (first < 0) continue;
    for (std::size_t c = 0; c < components; ++c) {
      const int entry = first + (source.symmetric ? sym_index[c] : int(c));
      value[c] = double(record[std::size_t(D + entry) * ParticleStore<D, T>::width]);
    }
  }
}

/// Minus the yield function of the particle's law; NaN where it has none. `point` is made once.
template <int D, class T>
double SimulationImpl<D, T>::yield_distance(const ParticleView& particle, const State& state,
                                            std::unique_ptr<MaterialPoint>& point) const {
  const BodyInfo& info = state.body->info();
  if (!point) {
    const std::any& input = setup_.bodies[std::size_t(info.body_index)].input;
    point = make_material_point(info.model, input, info.density, D);
  }
  std::size_t count = 0;
  for (const StateField& field : find_material_model(info.model)->fields) {
    count += std::size_t(field.components);
  }
  std::vector<double> entries(count);
  const T* record = state.body->store().batch(particle.batch) + particle.lane;
  for (std::size_t e = 0; e < count; ++e) {
    entries[e] = double(record[(std::size_t(D) + e) * ParticleStore<D, T>::width]);
  }
  point->set_entries(entries);
  const std::optional<double> value = point->yield_value();
  return value ? -*value : std::numeric_limits<double>::quiet_NaN();
}

/// The symmetric part of the velocity gradient of the last step: stored by the split path, else the
/// affine matrix over its moment where the particle was gathered, before it moved.
template <int D, class T>
void SimulationImpl<D, T>::write_strain_rate(const ParticleView& particle, const State& state,
                                             double* out) const {
  double gradient[D][D];
  if (!fused_ && step_ > 0) {
    const T* aux = state.body->store().aux_batch(particle.batch) + particle.lane;
    for (int k = 0; k < D * D; ++k) {
      const T* entry = aux + std::size_t(layout_.increment + k) * ParticleStore<D, T>::width;
      gradient[k / D][k % D] = double(*entry) / clock_.last_dt;
    }
  } else if (setup_.transfer == TransferType::mls) {
    const double h = setup_.cell_size;
    const T* gathered = state.body->store().aux_batch(particle.batch) + particle.lane +
                        std::max(stride_fields_.gathered, 0) * ParticleStore<D, T>::width;
    double u[D], affine[D][D];
    for (int a = 0; a < D; ++a) {
      const std::size_t k = std::size_t(a);
      const double moved = step_ > 0 ? clock_.last_dt * particle.velocity[k] : 0;
      u[a] = (particle.position[k] - moved - setup_.lower[k]) / h;
      if (stride_fields_.gathered >= 0 && step_ > 0)
        u[a] = gathered[a * ParticleStore<D, T>::width];
      u[a] -= std::floor(u[a]);  // the moment is the same in every cell
      for (int c = 0; c < D; ++c) affine[c][a] = particle.affine[c][a] / (h * h);
    }
    if (setup_.kernel == KernelType::compact) {
      times_inverse_moment<Compact, D>(u, affine, gradient);
    } else {
      times_inverse_moment<Quadratic, D>(u, affine, gradient);
    }
  } else {
    return;
  }
  std::fill_n(out, 9, 0.0);
  for (int c = 0; c < D; ++c) {
    for (int a = 0; a < D; ++a) out[3 * c + a] = 0.5 * (gradient[c][a] + gradient[a][c]);
  }
}

template <int D, class T>
std::vector<GridSnapshot> SimulationImpl<D, T>::grid() const {
  const Grid<D, T>& blocks = backend_->grid();
  std::vector<GridSnapshot> out;
  for (int lattice = 0; lattice < blocks.lattices(); ++lattice) {
    GridSnapshot snapshot;
    snapshot.time = clock_.time;
    snapshot.step = step_;
    snapshot.lattice = blocks.lattices() == 1 ? "nodes" : lattice == 0 ? "minus" : "plus";
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
  if (flow_) {
    out.push_back(flow_->grid());
    out.back().time = clock_.time;
    out.back().step = step_;
  }
  return out;
}

/// Values of the nodes inside the domain; nodes of blocks that are not active stay zero.
template <int D, class T>
void SimulationImpl<D, T>::fill_lattice(const GridSnapshot& snapshot, int lattice,
                                        std::vector<double>& mass,
                                        std::vector<double>& velocity) const {
  const Grid<D, T>& blocks = backend_->grid();
  const AlignedVector<T>& channel = backend_->velocities();
  if (channel.size() != blocks.size()) return;
  for (int b = 0; b < blocks.topology().size(); ++b) {
    for (int n = 0; n < block_node_count<D>; ++n) {
      const BlockCoord<D> node = blocks.node(b, n);
      std::int64_t at = 0;
      bool inside = true;
      for (int a = D - 1; a >= 0; --a) {
        inside = inside && node[a] >= 0 && node[a] < snapshot.nodes[a];
        at = at * snapshot.nodes[a] + node[a];
      }
      if (!inside) continue;
      const std::size_t record =
          (std::size_t(b) * std::size_t(blocks.lattices()) + std::size_t(lattice)) *
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
