// SPDX-License-Identifier: Apache-2.0
#include "verification/support/scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "materials/fixed_corotated.hpp"
#include "verification/reference/closed_forms.hpp"

namespace scree::testing {

namespace {

const char* const kernel_names[] = {"compact", "quadratic", "linear"};
const char* const transfer_names[] = {"mls", "apic", "flip", "pic"};
const char* const path_names[] = {"automatic", "fused", "split"};

void add_face(reference::Settings& settings, const SimulationSetup& setup, int axis, int side) {
  const FaceType type = setup.faces[axis][side];
  if (type == FaceType::open) return;
  reference::Face face;
  face.axis = axis;
  face.upper = side == 1;
  face.coordinate = side == 1 ? setup.cells[axis] * setup.cell_size : 0.0;
  face.rule = type != FaceType::sticky        ? reference::FaceRule::mirror
              : setup.no_slip == NoSlip::face ? reference::FaceRule::odd
                                              : reference::FaceRule::sticky;
  settings.faces.push_back(face);
}

reference::Settings reference_settings(const SimulationSetup& setup) {
  reference::Settings settings;
  settings.dimension = setup.dimension;
  settings.cell_size = setup.cell_size;
  settings.kernel = static_cast<reference::Kernel>(setup.kernel);
  settings.transfer = static_cast<reference::Transfer>(setup.transfer);
  settings.flip_blend = setup.flip_blend;
  if (setup.gravity) {
    const std::array<double, 3> g = setup.gravity(0.0);
    settings.gravity = Vector(g[0], g[1], setup.dimension == 3 ? g[2] : 0.0);
  }
  for (int axis = 0; axis < setup.dimension; ++axis)
    for (int side = 0; side < 2; ++side) add_face(settings, setup, axis, side);
  return settings;
}

}  // namespace

std::string to_string(const Method& method) {
  return std::string(kernel_names[static_cast<int>(method.kernel)]) + "_" +
         transfer_names[static_cast<int>(method.transfer)] + "_" +
         path_names[static_cast<int>(method.path)] +
         (method.precision == Precision::double_ ? "_double" : "_single");
}

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (KernelType kernel : {KernelType::compact, KernelType::quadratic, KernelType::linear})
    for (TransferType transfer :
         {TransferType::mls, TransferType::apic, TransferType::flip, TransferType::pic}) {
      const Method method{kernel, transfer, PathType::split, Precision::double_};
      if (method.affine() && kernel == KernelType::linear) continue;
      methods.push_back(method);
      if (transfer == TransferType::mls)
        methods.push_back({kernel, transfer, PathType::fused, Precision::double_});
    }
  return methods;
}

SimulationSetup make_setup(int dimension, const Method& method, double cell_size,
                           std::array<int, 3> cells, const Vector& lower) {
  SimulationSetup setup;
  setup.dimension = dimension;
  setup.precision = method.precision;
  setup.kernel = method.kernel;
  setup.transfer = method.transfer;
  setup.path = method.path;
  setup.cell_size = cell_size;
  for (int a = 0; a < 3; ++a) {
    setup.lower[a] = lower[a];
    setup.cells[a] = a < dimension ? cells[a] : 1;
    setup.faces[a] = {FaceType::open, FaceType::open};
  }
  return setup;
}

std::vector<Vector> lattice(const Vector& lower, const Vector& upper, double spacing, int dimension,
                            const std::function<bool(const Vector&)>& inside) {
  int count[3] = {1, 1, 1};
  for (int a = 0; a < dimension; ++a)
    count[a] = static_cast<int>(std::lround((upper[a] - lower[a]) / spacing));
  std::vector<Vector> points;
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) {
        Vector x = lower + spacing * Vector(i + 0.5, j + 0.5, k + 0.5);
        if (dimension == 2) x[2] = 0;
        if (!inside || inside(x)) points.push_back(x);
      }
  return points;
}

double Jelly::wave_speed() const {
  return std::sqrt(reference::oedometric_modulus(youngs_modulus, poissons_ratio) / density);
}

namespace {

BodySetup& add_body(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                    const char* model, std::any input, double density) {
  BodySetup body;
  body.name = body.material = body.model = model;
  body.input = std::move(input);
  body.density = density;
  body.material_index = static_cast<std::int32_t>(setup.bodies.size());
  body.particle_volume = std::pow(spacing, setup.dimension);
  for (const Vector& x : points) body.position.insert(body.position.end(), {x[0], x[1], x[2]});
  setup.bodies.push_back(std::move(body));
  return setup.bodies.back();
}

}  // namespace

BodySetup& add_jelly(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                     const Jelly& jelly, const std::string& name) {
  const FixedCorotated::Input input{jelly.youngs_modulus, jelly.poissons_ratio};
  BodySetup& body = add_body(setup, points, spacing, FixedCorotated::name, input, jelly.density);
  body.name = body.material = name;
  return body;
}

BodySetup& add_rubber(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                      const NeoHookean::Input& input, double density) {
  return add_body(setup, points, spacing, NeoHookean::name, input, density);
}

BodySetup& add_sand(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                    const DruckerPrager::Input& input, double density) {
  return add_body(setup, points, spacing, DruckerPrager::name, input, density);
}

BodySetup& add_fluid(SimulationSetup& setup, const std::vector<Vector>& points, double spacing,
                     const JFluid::Input& input, double density) {
  return add_body(setup, points, spacing, JFluid::name, input, density);
}

void set_velocity(BodySetup& body, const Vector& v0, const Matrix& gradient, const Vector& center) {
  const std::size_t count = body.position.size() / 3;
  body.velocity.clear();
  body.velocity_gradient.clear();
  for (std::size_t p = 0; p < count; ++p) {
    const Vector v = v0 + gradient * (Eigen::Map<const Vector>(&body.position[3 * p]) - center);
    body.velocity.insert(body.velocity.end(), {v[0], v[1], v[2]});
    for (int i = 0; i < 9; ++i) body.velocity_gradient.push_back(gradient(i / 3, i % 3));
  }
}

void set_steps(SimulationSetup& setup, int n, double dt, bool rows) {
  setup.step = dt;
  setup.schedule = Schedule(n * dt, rows ? dt : 0.0, 0.0, 0.0);
}

void run(Simulation& simulation, const Schedule& schedule) {
  while (!schedule.finished(simulation.time())) simulation.step();
}

std::vector<HistoryRow> run_with_history(Simulation& simulation, const Schedule& schedule) {
  std::vector<HistoryRow> rows{simulation.history()};
  while (!schedule.finished(simulation.time())) {
    simulation.step();
    if (schedule.history_due(simulation.time())) rows.push_back(simulation.history());
  }
  return rows;
}

State state_of(const Simulation& simulation) {
  const ParticleSnapshot snapshot = simulation.particles({"velocity", "deformation_gradient"});
  const SnapshotField& velocity = field(snapshot, "velocity");
  const SnapshotField& gradient = field(snapshot, "deformation_gradient");
  State state;
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    state.x.push_back(Eigen::Map<const Vector>(&snapshot.position[3 * p]));
    Vector v = Vector::Zero();
    for (int c = 0; c < velocity.components; ++c)
      v[c] = velocity.values[p * velocity.components + c];
    state.v.push_back(v);
    Matrix F;
    for (int i = 0; i < 9; ++i) F(i / 3, i % 3) = gradient.values[9 * p + i];
    state.F.push_back(F);
  }
  return state;
}

const SnapshotField& field(const ParticleSnapshot& snapshot, const std::string& name) {
  for (const SnapshotField& f : snapshot.fields)
    if (f.name == name) return f;
  throw std::runtime_error("no field " + name);
}

namespace {

template <class V>
double largest_distance(const std::vector<V>& a, const std::vector<V>& b) {
  if (a.size() != b.size()) return INFINITY;
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const double d = (a[n] - b[n]).norm();
    if (std::isnan(d)) return d;
    largest = std::max(largest, d);
  }
  return largest;
}

}  // namespace

double distance(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  return largest_distance(a, b);
}

double distance(const std::vector<Matrix>& a, const std::vector<Matrix>& b) {
  return largest_distance(a, b);
}

State Twin::state() const {
  State state;
  for (const reference::Particle& p : solver->particles()) {
    state.x.push_back(p.x + lower);
    state.v.push_back(p.v);
    state.F.push_back(p.state.F);
  }
  return state;
}

namespace {

std::unique_ptr<reference::Material> reference_sand(const DruckerPrager::Input& in, bool flat) {
  const reference::Lame lame(in.youngs_modulus, in.poissons_ratio);
  const bool plane_strain =
      in.match == Match::plane_strain || (in.match == Match::by_dimension && flat);
  const double M = plane_strain ? reference::cone_slope_plane_strain(in.friction_angle)
                                : reference::cone_slope_compression(in.friction_angle);
  const double shift = in.cohesion / std::tan(in.friction_angle) / (3 * lame.lambda + 2 * lame.mu);
  return reference::drucker_prager(
      {in.youngs_modulus, in.poissons_ratio, reference::cone_alpha(M), 0, shift});
}

std::unique_ptr<reference::Material> reference_material(const BodySetup& body, bool flat) {
  if (const auto* jelly = std::any_cast<FixedCorotated::Input>(&body.input))
    return reference::fixed_corotated(jelly->youngs_modulus, jelly->poissons_ratio);
  if (const auto* rubber = std::any_cast<NeoHookean::Input>(&body.input))
    return reference::neo_hookean(rubber->youngs_modulus, rubber->poissons_ratio);
  if (const auto* sand = std::any_cast<DruckerPrager::Input>(&body.input))
    return reference_sand(*sand, flat);
  const auto& fluid = std::any_cast<const JFluid::Input&>(body.input);
  return reference::j_fluid(fluid.bulk_modulus, fluid.gamma, fluid.viscosity);
}

reference::Particle reference_particle(const BodySetup& body, std::size_t p) {
  reference::Particle particle;
  particle.x = Eigen::Map<const Vector>(&body.position[3 * p]);
  particle.volume = body.particle_volume;
  particle.mass = body.density * body.particle_volume;
  if (!body.velocity.empty()) particle.v = Eigen::Map<const Vector>(&body.velocity[3 * p]);
  return particle;
}

}  // namespace

Twin reference_twin(const SimulationSetup& setup) {
  const bool flat = setup.dimension == 2;
  const bool affine = setup.transfer == TransferType::mls || setup.transfer == TransferType::apic;
  Twin twin;
  twin.lower = Vector(setup.lower[0], setup.lower[1], flat ? 0.0 : setup.lower[2]);
  twin.solver = std::make_unique<reference::Solver>(reference_settings(setup));
  for (const BodySetup& body : setup.bodies) {
    twin.materials.push_back(reference_material(body, flat));
    for (std::size_t p = 0; p < body.position.size() / 3; ++p) {
      reference::Particle particle = reference_particle(body, p);
      particle.x -= twin.lower;
      particle.material = twin.materials.back().get();
      if (affine && !body.velocity_gradient.empty()) {
        const Matrix L = Eigen::Map<const Matrix>(&body.velocity_gradient[9 * p]).transpose();
        particle.B = reference::affine_matrix(twin.solver->settings(), particle.x, L);
      }
      twin.solver->particles().push_back(particle);
    }
  }
  return twin;
}

}  // namespace scree::testing
