// SPDX-License-Identifier: Apache-2.0
#include "app/build_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "solver/base/error.hpp"
#include "solver/deck/coupling_checks.hpp"
#include "solver/deck/expression.hpp"
#include "solver/deck/initial_pressure.hpp"
#include "solver/deck/initial_stress.hpp"
#include "solver/deck/particle_faults.hpp"
#include "solver/particles/sampling.hpp"
#include "solver/particles/shape.hpp"
#include "solver/simulation/fault_text.hpp"

namespace scree {
namespace {

/// Up to three expressions of the same variables; a component that is not given is zero.
class Field {
 public:
  Field(const std::array<Formula, 3>& formulas, int dimension,
        const std::vector<std::string>& variables) {
    for (int a = 0; a < dimension; ++a) {
      const Formula& formula = formulas[std::size_t(a)];
      components_.emplace_back(formula.given() ? formula.text : "0", variables);
    }
  }

  static bool given(const std::array<Formula, 3>& formulas) {
    return std::any_of(formulas.begin(), formulas.end(),
                       [](const Formula& f) { return f.given(); });
  }

  std::array<double, 3> operator()(const double* variables) const {
    std::array<double, 3> value{};
    for (std::size_t a = 0; a < components_.size(); ++a) value[a] = components_[a](variables);
    return value;
  }

  /// The text of the first component that has no finite value, or nothing.
  const std::string* undefined(const std::array<double, 3>& value) const {
    for (std::size_t a = 0; a < components_.size(); ++a) {
      if (!std::isfinite(value[a])) return &components_[a].text();
    }
    return nullptr;
  }

 private:
  std::vector<Expression> components_;
};

/// A formula that is a number at every particle, but not beside one.
[[noreturn]] void refuse_velocity(const BodySpec& spec, std::size_t component, const double* x,
                                  int dimension) {
  throw UserError("body." + toml_key(spec.name) + ".velocity: \"" + spec.velocity[component].text +
                  "\" is not finite beside the particle at " +
                  point_text({x[0], x[1], x[2]}, dimension) +
                  " m; the velocity gradient needs it within 0.002 cells");
}

/// Velocity and its gradient at every particle, the gradient by differences of fourth order.
void set_velocity(const BodySpec& spec, int dimension, double cell_size, BodySetup& body) {
  if (!Field::given(spec.velocity)) return;
  const Field field(spec.velocity, dimension, {"x", "y", "z"});
  const double h = 1e-3 * cell_size;  // truncation h^4 and rounding eps/h are both about 1e-12
  const std::size_t count = body.position.size() / 3;
  body.velocity.resize(3 * count);
  body.velocity_gradient.assign(9 * count, 0.0);
  for (std::size_t p = 0; p < count; ++p) {
    const double* x = &body.position[3 * p];
    const std::array<double, 3> v = field(x);
    std::copy(v.begin(), v.end(), &body.velocity[3 * p]);
    for (int j = 0; j < dimension; ++j) {
      const auto at = [&](double shift) {
        double y[3] = {x[0], x[1], x[2]};
        y[j] += shift;
        return field(y);
      };
      const auto m2 = at(-2 * h);
      const auto m1 = at(-h);
      const auto p1 = at(h);
      const auto p2 = at(2 * h);
      for (int i = 0; i < dimension; ++i) {
        const std::size_t k = std::size_t(i);
        for (const double value : {m2[k], m1[k], p1[k], p2[k]}) {
          if (!std::isfinite(value)) refuse_velocity(spec, k, x, dimension);
        }
        body.velocity_gradient[9 * p + 3 * k + std::size_t(j)] =
            (m2[k] - p2[k] + 8 * (p1[k] - m1[k])) / (12 * h);
      }
    }
  }
}

void add_tractions(const Deck& deck, std::int32_t body, const SampledBody& sampled,
                   SimulationSetup& setup) {
  for (const TractionSpec& spec : deck.tractions) {
    if (spec.body != deck.bodies[std::size_t(body)].name) continue;
    setup.tractions.push_back({spec, body, loaded_faces(deck, spec, sampled)});
  }
}

/// Pores, their pressure at the start and the surfaces that drain, of one body.
void add_water(const Deck& deck, const MaterialSpec& material, const SampledBody& sampled,
               std::int32_t index, BodySetup& body, SimulationSetup& setup) {
  if (!deck.coupling) return;
  body.pores = material.pores();
  if (!body.pores) return;
  const InitialPressure pressure(deck, material);
  for (std::size_t p = 0; p < sampled.position.size(); p += 3) {
    body.pore_pressure.push_back(pressure.at(&sampled.position[p]));
  }
  for (const DrainageSpec& spec : deck.drainage) {
    if (spec.body != body.name) continue;
    DrainageSetup drainage;
    drainage.name = spec.name;
    drainage.type = spec.type;
    drainage.body = index;
    drainage.faces = drained_faces(deck, spec, sampled);
    const Formula& value = spec.type == DrainageType::flux ? spec.flux : spec.pressure;
    if (value.given()) {
      const Expression expression(value.text, {"x", "y", "z", "t"});
      drainage.value = [expression](const double* x, double t) {
        const double variables[4] = {x[0], x[1], x[2], t};
        return expression(variables);
      };
    }
    setup.coupling->drainage.push_back(std::move(drainage));
  }
}

/// What the reading of the deck leaves to this: it does not sample very large bodies.
void check_particles(const Deck& deck, const BodySpec& body, const SampledBody& sampled) {
  const auto faults = particle_faults(deck, body, sampled, Problems());
  if (faults.empty()) return;
  const BodyFault& fault = faults.front();
  throw UserError(fault.key() + ": " + fault.message +
                  (fault.repair.empty() ? "" : "; " + fault.repair));
}

void add_body(const Deck& deck, std::int32_t index, SimulationSetup& setup) {
  const BodySpec& spec = deck.bodies[std::size_t(index)];
  const MaterialSpec& material = *deck.find_material(spec.material);
  const auto shape = make_shape(spec.shape, deck.domain.dimension);
  SampledBody sampled = sample(*shape, deck.domain.lower, deck.domain.cell_size,
                               spec.particles_per_direction, deck.domain.dimension);
  check_particles(deck, spec, sampled);
  add_tractions(deck, index, sampled, setup);
  BodySetup body;
  body.name = spec.name;
  body.material = material.name;
  body.model = material.model;
  body.input = material.input;
  body.density = material.density;
  body.undrained_bulk_modulus = material.undrained_bulk_modulus.value_or(0);
  body.material_index = std::int32_t(&material - deck.materials.data());
  body.particle_volume = sampled.particle_volume;
  add_water(deck, material, sampled, index, body, setup);
  body.position = std::move(sampled.position);
  if (spec.initial_stress) {
    InitialStates initial = solve_initial_states(deck, spec, body.position);
    body.states = std::move(initial.states);
    body.state_of = std::move(initial.state_of);
  }
  set_velocity(spec, deck.domain.dimension, deck.domain.cell_size, body);
  setup.bodies.push_back(std::move(body));
}

void set_loads(const Deck& deck, SimulationSetup& setup) {
  const int dimension = deck.domain.dimension;
  if (Field::given(deck.method.gravity)) {
    setup.gravity = [field = Field(deck.method.gravity, dimension, {"t"})](double t) {
      const auto value = field(&t);
      if (const std::string* text = field.undefined(value)) {
        throw RunFault(
            fmt::format("method.gravity: \"{}\" is not finite at t = {:.6g} s", *text, t));
      }
      return value;
    };
  }
  if (Field::given(deck.method.body_force)) {
    const Field field(deck.method.body_force, dimension, {"X", "Y", "Z", "x", "y", "z", "t"});
    setup.body_force = [field, dimension](const double* X, const double* x, double t) {
      const double variables[7] = {X[0], X[1], X[2], x[0], x[1], x[2], t};
      const auto value = field(variables);
      if (const std::string* text = field.undefined(value)) {
        throw RunFault(
            fmt::format("method.body_force: \"{}\" is not finite at t = {:.6g} s for the particle "
                        "at {}, at the start at {}",
                        *text, t, place_text(x, dimension), place_text(X, dimension)));
      }
      return value;
    };
  }
}

}  // namespace

Schedule build_schedule(const Deck& deck) {
  const auto window = [](const OutputSpec& spec) {
    constexpr double always = std::numeric_limits<double>::infinity();
    return EventStream{spec.every, spec.from, spec.until.value_or(always)};
  };
  Schedule schedule(deck.time.end, deck.history.every, 0, deck.checkpoint.every.value_or(0));
  if (deck.output.format != FrameFormat::none) schedule.set_frames(window(deck.output));
  for (const OutputSpec& frames : deck.frames) schedule.add(window(frames));
  for (const ProbeSpec& probe : deck.probes) schedule.add({probe.every});
  for (const ProfileSpec& profile : deck.profiles) schedule.add({profile.every});
  for (const SectionSpec& section : deck.sections) schedule.add({section.every});
  return schedule;
}

SimulationSetup build_setup(const Deck& deck) {
  SimulationSetup setup;
  setup.dimension = deck.domain.dimension;
  setup.precision = deck.method.precision;
  setup.lower = deck.domain.lower;
  for (std::size_t a = 0; a < 3; ++a) setup.cells[a] = deck.domain.cells[a];
  setup.cell_size = deck.domain.cell_size;
  setup.kernel = deck.method.kernel;
  setup.transfer = deck.method.transfer;
  setup.flip_blend = deck.method.flip_blend;
  setup.volumetric_locking = deck.method.volumetric_locking;
  setup.deterministic = deck.method.deterministic;
  setup.cfl = deck.time.cfl;
  setup.step = deck.time.step;
  setup.damping = deck.method.damping.value > 0 ? deck.method.damping.type : DampingType::none;
  setup.damping_value = deck.method.damping.value;
  for (int a = 0; a < setup.dimension; ++a) {
    for (int side = 0; side < 2; ++side) {
      const FaceSpec& face = deck.boundary.face(a, side);
      setup.faces[std::size_t(a)][std::size_t(side)] = face.type;
      setup.face_friction[std::size_t(a)][std::size_t(side)] = face.coefficient;
    }
  }
  setup.no_slip = deck.boundary.no_slip;
  setup.colliders = deck.colliders;
  set_loads(deck, setup);
  if (deck.coupling) {
    setup.coupling.emplace();
    setup.coupling->pressure_spacing = deck.coupling->pressure_spacing;
    setup.coupling->tolerance = deck.coupling->tolerance;
    setup.coupling->preconditioner = deck.coupling->preconditioner;
    setup.coupling->solver_options = deck.coupling->solver_options;
    setup.coupling->halvings = deck.coupling->halvings;
    setup.coupling->stride = deck.coupling->stride;
    setup.coupling->stride_drift = deck.coupling->stride_drift;
  }
  for (std::size_t b = 0; b < deck.bodies.size(); ++b) add_body(deck, std::int32_t(b), setup);
  setup.keep_reference =
      deck.wants_field("displacement") || setup.body_force || !setup.tractions.empty();
  setup.schedule = build_schedule(deck);
  return setup;
}

}  // namespace scree
