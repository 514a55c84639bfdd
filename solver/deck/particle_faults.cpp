// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/particle_faults.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "solver/deck/coupling_checks.hpp"
#include "solver/deck/expression.hpp"
#include "solver/deck/key_text.hpp"
#include "solver/particles/shape.hpp"

namespace scree {
namespace {

/// What a formula may depend on here.
enum class Depends { place, place_and_time };

/// Why a formula is no number at t = 0 at one of the particles, or nothing. `particles` are
/// indices; empty: all.
std::optional<std::string> fault_of(const Formula& formula, Depends depends, int dimension,
                                    const std::vector<double>& position,
                                    const std::vector<std::int64_t>& particles = {}) {
  if (!formula.given()) return std::nullopt;
  const bool timed = depends == Depends::place_and_time;
  const std::vector<std::string> place{"x", "y", "z"}, all{"x", "y", "z", "X", "Y", "Z", "t"};
  const Expression expression(formula.text, timed ? all : place);
  const std::size_t every = particles.empty() ? position.size() / 3 : particles.size();
  const std::size_t count = expression.constant() ? std::min<std::size_t>(every, 1) : every;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t p = particles.empty() ? i : static_cast<std::size_t>(particles[i]);
    const std::array<double, 3> x{position[3 * p], position[3 * p + 1], position[3 * p + 2]};
    const double values[7] = {x[0], x[1], x[2], x[0], x[1], x[2], 0};
    if (std::isfinite(expression(values))) continue;
    std::string message = "\"" + formula.text + "\" is not finite";
    if (!expression.constant()) {
      message += " at the particle at " + point_text(x, dimension) + " m";
      if (timed) message += ", t = 0";
    }
    return message;
  }
  return std::nullopt;
}

/// Collects the faults of one body.
class Finder {
 public:
  Finder(const Deck& deck, const SampledBody& particles, const Problems& problems)
      : deck_(deck), particles_(particles), problems_(problems) {}

  void formulas(const std::vector<std::string>& path, const std::array<Formula, 3>& components,
                Depends depends, const std::vector<std::int64_t>& particles = {}) {
    if (problems_.any_under(key_text(path))) return;
    for (const Formula& formula : components) {
      const auto fault =
          fault_of(formula, depends, deck_.domain.dimension, particles_.position, particles);
      if (!fault) continue;
      faults_.push_back({path, *fault, ""});
      return;
    }
  }

  void traction(const TractionSpec& spec) {
    const std::string key = key_text({"traction", spec.name});
    for (const char* needed : {".region", ".facing"}) {
      if (problems_.any_under(key + needed)) return;
    }
    if (problems_.any_under("boundary")) return;
    const SurfacePatch patch = loaded_faces(deck_, spec, particles_);
    if (patch.count() == 0) {
      faults_.push_back({{"traction", spec.name, "region"},
                         "holds no face of the body's surface, so that nothing is loaded",
                         "move or enlarge it until it holds centres of faces, or see `facing`"});
      return;
    }
    formulas({"traction", spec.name, "pressure"}, {spec.pressure, {}, {}}, Depends::place_and_time,
             patch.particle);
    formulas({"traction", spec.name, "value"}, spec.value, Depends::place_and_time, patch.particle);
  }

  void drainage(const DrainageSpec& spec) {
    const std::string key = key_text({"drainage", spec.name});
    if (problems_.any_under(key) || problems_.any_under("boundary")) return;
    const std::vector<DrainedFace> faces = drained_faces(deck_, spec, particles_);
    if (faces.empty()) {
      faults_.push_back({{"drainage", spec.name, spec.region ? "region" : "body"},
                         "holds no free face of the body's surface, so that nothing drains",
                         "move or enlarge the region until it holds centres of faces; see `facing` "
                         "and, for faces on a closed face of the domain, `walls`"});
      return;
    }
    if (shared(spec, faces)) return;
    const Formula& value = spec.type == DrainageType::flux ? spec.flux : spec.pressure;
    if (!value.given()) return;
    const Expression expression(value.text, {"x", "y", "z", "t"});
    for (const DrainedFace& face : faces) {
      std::array<double, 3> x = face.offset;
      for (std::size_t a = 0; a < 3; ++a) {
        x[a] += particles_.position[3 * std::size_t(face.particle) + a];
      }
      const double values[4] = {x[0], x[1], x[2], 0};
      if (std::isfinite(expression(values))) continue;
      faults_.push_back({{"drainage", spec.name, "value"},
                         "\"" + value.text + "\" is not finite at " +
                             point_text(x, deck_.domain.dimension) + " m, t = 0",
                         ""});
      return;
    }
  }

  std::vector<BodyFault> faults() && { return std::move(faults_); }

 private:
  /// Reports a face that another drainage holds too.
  bool shared(const DrainageSpec& spec, const std::vector<DrainedFace>& faces) {
    for (const DrainedFace& face : faces) {
      const auto [other, fresh] =
          drained_.emplace(std::pair(face.particle, face.offset), spec.name);
      if (fresh) continue;
      faults_.push_back({{"drainage", spec.name, spec.region ? "region" : "body"},
                         "holds faces that drainage." + toml_key(other->second) + " holds too",
                         "choose regions or `facing` so that each face belongs to one of them"});
      return true;
    }
    return false;
  }

  const Deck& deck_;
  const SampledBody& particles_;
  const Problems& problems_;
  /// Faces, by particle and place, and the drainage that holds them.
  std::map<std::pair<std::int64_t, std::array<double, 3>>, std::string> drained_;
  std::vector<BodyFault> faults_;
};

}  // namespace

std::string BodyFault::key() const { return key_text(path); }

std::string point_text(const std::array<double, 3>& x, int dimension) {
  std::string text;
  for (int i = 0; i < dimension; ++i) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", x[static_cast<std::size_t>(i)]);
    text += (i == 0 ? "[" : ", ") + std::string(buffer);
  }
  return text + "]";
}

SurfacePatch loaded_faces(const Deck& deck, const TractionSpec& traction, const SampledBody& body) {
  const auto region = make_shape(traction.region, deck.domain.dimension);
  SurfaceSelection selection;
  selection.region = region.get();
  selection.facing = traction.facing;
  for (int a = 0; a < deck.domain.dimension; ++a) {
    for (int side = 0; side < 2; ++side) {
      selection.wall[std::size_t(a)][std::size_t(side)] =
          deck.boundary.face(a, side).type != FaceType::open;
    }
  }
  selection.domain_upper = deck.domain.upper;
  return exposed_faces(body, selection);
}

std::vector<BodyFault> particle_faults(const Deck& deck, const BodySpec& body,
                                       const SampledBody& particles, const Problems& problems) {
  Finder finder(deck, particles, problems);
  finder.formulas({"body", body.name, "velocity"}, body.velocity, Depends::place);
  finder.formulas({"method", "body_force"}, deck.method.body_force, Depends::place_and_time);
  for (const TractionSpec& traction : deck.tractions) {
    if (traction.body == body.name) finder.traction(traction);
  }
  if (deck.coupling) {
    const MaterialSpec* material = deck.find_material(body.material);
    if (material != nullptr && material->porosity) {
      finder.formulas({"coupling", "initial_pressure"}, {deck.coupling->initial_pressure, {}, {}},
                      Depends::place);
    }
    for (const DrainageSpec& drainage : deck.drainage) {
      if (drainage.body == body.name) finder.drainage(drainage);
    }
  }
  return std::move(finder).faults();
}

}  // namespace scree
