// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "solver/base/error.hpp"
#include "solver/coupling/coupled_flow.hpp"
#include "solver/device/device_backend.hpp"
#include "solver/simulation/cpu_backend.hpp"
#include "solver/simulation/lone_particle.hpp"
#include "solver/simulation/periods_of.hpp"
#include "solver/simulation/simulation_impl.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {
namespace {

int lattices_of(KernelType kernel) { return kernel == KernelType::compact ? 2 : 1; }

/// What keeps a run from the fused path, as the path would say it; empty: nothing does.
std::string fused_path_needs(const SimulationSetup& setup) {
  if (setup.transfer != TransferType::mls) return "transfer mls";
  if (setup.kernel == KernelType::linear) return "the compact or quadratic kernel";
  if (setup.damping == DampingType::local) return "a run without local damping";
  if (setup.body_force) return "a run without body forces";
  if (!setup.tractions.empty()) return "a run without tractions";
  if (setup.volumetric_locking != VolumetricLocking::none) return "volumetric_locking = \"none\"";
  if (setup.coupling && setup.coupling->halvings > 0) {
    return "coupling.halvings = 0: a step whose forces are on the grid already cannot be halved";
  }
  return "";
}

bool can_fuse(const SimulationSetup& setup) { return fused_path_needs(setup).empty(); }

bool needs_separate_force(const SimulationSetup& setup) {
  return setup.transfer == TransferType::flip || setup.damping == DampingType::local;
}

template <int D>
BlockCoord<D> home_block(const std::array<double, 3>& cells, std::array<double, 3>& local) {
  BlockCoord<D> block{};
  for (int a = 0; a < D; ++a) {
    block[a] = int(std::floor((cells[a] - home_begin) / block_cells));
    local[a] = cells[a] - double(block_cells) * block[a];
  }
  return block;
}

template <class Kernel, int D>
void times_moment_at(const double (&u)[D], const double (&m)[D][D], double (&out)[D][D]) {
  Kernel::template times_moment<double, D>(Kernel::template at<double, D>(u), m, out);
}

/// B0 = grad v0 D(x0) for the transfers that carry an affine matrix, else 0: a particle whose
/// affine matrix ignores its velocity field loses energy in the first step.
template <int D>
void initial_affine(KernelType kernel, TransferType transfer, const double (&u)[D],
                    const double (&gradient)[D][D], double (&affine)[D][D]) {
  const bool carries = transfer == TransferType::mls || transfer == TransferType::apic;
  if (carries && kernel == KernelType::compact)
    return times_moment_at<Compact>(u, gradient, affine);
  if (carries && kernel == KernelType::quadratic) {
    return times_moment_at<Quadratic>(u, gradient, affine);
  }
  for (auto& row : affine) std::fill(row, row + D, 0.0);
}

}  // namespace

std::unique_ptr<Simulation> create_on_device(SimulationSetup setup,
                                             std::shared_ptr<const DeviceToolkit> device) {
  const bool flat = setup.dimension == 2;
  if (setup.precision == Precision::double_) {
    if (flat) return std::make_unique<SimulationImpl<2, double>>(std::move(setup), device);
    return std::make_unique<SimulationImpl<3, double>>(std::move(setup), device);
  }
  if (flat) return std::make_unique<SimulationImpl<2, float>>(std::move(setup), device);
  return std::make_unique<SimulationImpl<3, float>>(std::move(setup), device);
}

std::unique_ptr<Simulation> Simulation::create(SimulationSetup setup) {
  return create_on_device(std::move(setup), nullptr);
}

template <int D, class T>
SimulationImpl<D, T>::SimulationImpl(SimulationSetup setup,
                                     std::shared_ptr<const DeviceToolkit> device)
    : setup_(std::move(setup)),
      device_(std::move(device)),
      fused_(setup_.path == PathType::automatic
                 ? can_fuse(setup_) && !(device_ && setup_.deterministic)
                 : setup_.path == PathType::fused),
      separate_(needs_separate_force(setup_)),
      layout_(make_layout(true)),
      stride_fields_(stride_fields(layout_)),
      executor_(setup_.threads),
      domain_(make_domain()) {
  check_path();
  setup_.cfl = courant_number(setup_);
  for (const ColliderSpec& spec : setup_.colliders)
    colliders_.emplace_back(spec, D, setup_.cell_size, periods_of(setup_));
  collider_work_.assign(colliders_.size(), 0);
  std::vector<std::int64_t> first_id;
  std::vector<double> mass;
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    add_body(setup_.bodies[b], std::int32_t(b));
    first_id.push_back(bodies_.back().first_id);
    mass.push_back(bodies_.back().body->info().particle_mass());
  }
  if (setup_.body_force || !setup_.tractions.empty()) {
    external_ = std::make_unique<ExternalForce>(setup_.body_force, setup_.tractions, D, first_id,
                                                mass, initial_count_);
    setup_.tractions.clear();
  }
  backend_ = make_backend();
  backend_->take_particles();
  make_flow();
  if (external_ && external_->tractions_only() && !flow_) {
    loads_alone_ = backend_->load_only(external_->loaded_ids());
  }
  // Of the bodies' setups the output still needs the laws' inputs; the particles' arrays go.
  for (BodySetup& body : setup_.bodies) {
    BodySetup rest;
    rest.input = std::move(body.input);
    body = std::move(rest);
  }
  first_step();
}

/// What the deck's checks leave to this: paths and devices are no keys of it.
template <int D, class T>
void SimulationImpl<D, T>::check_path() const {
  if (const std::string needs = fused_path_needs(setup_); fused_ && !needs.empty()) {
    throw UserError("the fused path needs " + needs);
  }
  if (averages() && device_) {
    throw UserError("volumetric_locking is computed by the processor; use the backend cpu");
  }
  if (fused_ && device_ && setup_.deterministic) {
    throw UserError("deterministic runs on a device take the split path");
  }
}

template <int D, class T>
GridDomain<D> SimulationImpl<D, T>::make_domain() const {
  GridDomain<D> domain;
  domain.lattices = lattices_of(setup_.kernel);
  for (int a = 0; a < D; ++a) {
    domain.cells[a] = setup_.cells[a];
    for (int side = 0; side < 2; ++side) {
      const FaceType type = setup_.faces[a][side];
      domain.faces[a][side] = type == FaceType::open       ? FaceKind::none
                              : type == FaceType::periodic ? FaceKind::periodic
                                                           : FaceKind::mirror;
    }
  }
  return domain;
}

template <int D, class T>
Faces<D> SimulationImpl<D, T>::make_faces() const {
  Faces<D> faces;
  for (int a = 0; a < D; ++a) {
    faces.type[a] = setup_.faces[a];
    faces.friction[a] = setup_.face_friction[a];
  }
  faces.no_slip = setup_.no_slip;
  return faces;
}

template <int D, class T>
std::unique_ptr<Backend<D, T>> SimulationImpl<D, T>::make_backend() {
  BackendConfig<D> config;
  config.kernel = setup_.kernel;
  config.transfer = setup_.transfer;
  config.fused = fused_;
  config.separate_force = separate_;
  config.volume_ratio = volume_ratio_field();
  config.deterministic = setup_.deterministic;
  config.domain = domain_;
  config.faces = make_faces();
  config.lower = setup_.lower;
  config.cell_size = setup_.cell_size;
  if (device_) {
    return std::make_unique<DeviceBackend<D, T>>(config, layout_, bodies_, executor_.pool(),
                                                 *device_, setup_.bodies);
  }
  return std::make_unique<CpuBackend<D, T>>(config, layout_, bodies_, executor_);
}

/// `motion`: with what p2g and records read. The pore water's points read dt grad v.
template <int D, class T>
AuxLayout SimulationImpl<D, T>::make_layout(bool motion) const {
  AuxLayout layout;
  if (motion) {
    layout.velocity = 0;
    layout.affine = D;
    layout.stress = D + D * D;
    layout.total = layout.stress + 6;
  }
  const auto place = [&](int entries) {
    layout.total += entries;
    return layout.total - entries;
  };
  if (fused_ && !setup_.coupling) return layout;
  layout.increment = place(D * D);
  if (fused_) {
    layout.total = stride_fields(layout).end(layout.total, D);
    return layout;
  }
  const bool changing_weight = setup_.coupling && setup_.gravity;
  if (setup_.body_force || !setup_.tractions.empty() || changing_weight) layout.external = place(D);
  if (averages()) layout.total += volume_aux_fields;  // last
  return layout;
}

/// Where the fields of strides lie, behind the others; none without strides.
template <int D, class T>
StrideFields SimulationImpl<D, T>::stride_fields(const AuxLayout& layout) const {
  StrideFields fields;
  if (!fused_ || !setup_.coupling) return fields;
  int next = layout.increment + D * D;
  fields.growth = next++;
  if (setup_.gravity) fields.gained = next++;
  if (layout.velocity < 0) return fields;
  fields.gathered = next;
  fields.ahead = next + D;
  return fields;
}

template <int D, class T>
void SimulationImpl<D, T>::add_body(const BodySetup& setup, std::int32_t index) {
  BodyInfo info;
  info.name = setup.name;
  info.material = setup.material;
  info.model = setup.model;
  info.body_index = index;
  info.material_index = setup.material_index;
  info.particle_volume = setup.particle_volume;
  info.density = setup.density;
  info.undrained_bulk_modulus = setup.undrained_bulk_modulus;
  State state;
  state.first_id = initial_count_;
  state.body = make_body<D, T>(info, setup.input);
  state.body->store().resize_aux(layout_.total);
  place_particles(setup, state);
  if (averages()) start_volume_ratios(state);
  bounds_.max_signal =
      std::max(bounds_.max_signal, state.body->initial_signal_speed(setup_.cell_size));
  if (setup_.keep_reference) {
    reference_.insert(reference_.end(), setup.position.begin(), setup.position.end());
  }
  initial_count_ += state.body->store().count();
  bodies_.push_back(std::move(state));
}

template <int D, class T>
void SimulationImpl<D, T>::place_particles(const BodySetup& setup, State& state) {
  ParticleStore<D, T>& store = state.body->store();
  const std::size_t count = setup.position.size() / 3;
  store.reserve(std::int64_t(count) + std::int64_t(count) / 16);
  for (std::size_t p = 0; p < count; ++p) {
    std::array<double, 3> cells{};
    std::array<double, 3> local{};
    for (int a = 0; a < D; ++a) {
      cells[a] = (setup.position[3 * p + a] - setup_.lower[a]) / setup_.cell_size;
      if (!(cells[a] >= 0 && cells[a] <= setup_.cells[a])) {
        throw UserError("a particle of body " + setup.name + " lies outside the domain");
      }
    }
    const std::uint64_t key = block_key<D>(home_block<D>(cells, local));
    const std::int64_t slot = store.append(key, state.first_id + std::int64_t(p));
    for (int a = 0; a < D; ++a) store.value(slot, a) = T(local[a]);
    if (!setup.state_of.empty()) {
      const std::vector<double>& entries = setup.states[std::size_t(setup.state_of[p])];
      for (std::size_t i = 0; i < entries.size(); ++i)
        store.value(slot, D + int(i)) = T(entries[i]);
    }
    set_motion(setup, p, local, slot, store);
  }
  store.finish_blocks();
}

/// What the law's state says at t = 0; average_volumes() goes on from there.
template <int D, class T>
void SimulationImpl<D, T>::start_volume_ratios(State& state) {
  constexpr int width = ParticleStore<D, T>::width;
  ParticleStore<D, T>& store = state.body->store();
  const VolumeFields fields = volume_fields(*state.body, volume_ratio_field());
  for (const auto& block : store.blocks()) {
    for (std::size_t k = 0; k < block.batches.size(); ++k) {
      const std::int32_t batch = block.batches[k];
      const int active = std::min(width, block.count - int(k) * width);
      double ratio[width], energy[width];
      state.body->evaluate(store.batch(batch), active, ratio, energy);
      for (int l = 0; l < active; ++l) {
        const std::int64_t slot = std::int64_t(batch) * width + l;
        store.aux_value(slot, fields.ratio) = T(ratio[l]);
        Mat3<double> F = identity3<double>();
        for (int i = 0; fields.gradient >= 0 && i < 9; ++i) {
          F(i / 3, i % 3) = double(store.value(slot, fields.gradient + i));
        }
        store.aux_value(slot, fields.plastic) = T(std::log(ratio[l] / det(F)));
      }
    }
  }
}

/// Velocity and affine matrix of particle p, at `local` [cells from its block's corner].
template <int D, class T>
void SimulationImpl<D, T>::set_motion(const BodySetup& setup, std::size_t p,
                                      const std::array<double, 3>& local, std::int64_t slot,
                                      ParticleStore<D, T>& store) {
  for (int a = 0; a < D; ++a) {
    const double v = setup.velocity.empty() ? 0.0 : setup.velocity[3 * p + a];
    store.aux_value(slot, layout_.velocity + a) = T(v);
    bounds_.max_speed = std::max(bounds_.max_speed, std::abs(v));
  }
  if (setup.velocity_gradient.empty()) return;
  double gradient[D][D];
  double affine[D][D];
  double u[D];
  for (int i = 0; i < D; ++i) {
    u[i] = local[i];
    for (int j = 0; j < D; ++j) {
      gradient[i][j] = setup.velocity_gradient[9 * p + 3 * i + j] * setup_.cell_size;
    }
  }
  initial_affine(setup_.kernel, setup_.transfer, u, gradient, affine);
  for (int i = 0; i < D * D; ++i) {
    store.aux_value(slot, layout_.affine + i) = T(affine[i / D][i % D]);
  }
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
