// SPDX-License-Identifier: Apache-2.0
#include "app/deck_warnings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "materials/registry.hpp"
#include "solver/boundary/collider.hpp"
#include "solver/particles/shape.hpp"
#include "solver/particles/shape_volume.hpp"
#include "solver/simulation/lone_particle.hpp"
#include "solver/simulation/periods_of.hpp"

namespace scree {
namespace {

/// Beyond this the particles are too coarse for their shape.
constexpr double most_missing = 0.05;

const char* mass_unit(const Deck& deck) { return deck.domain.dimension == 2 ? "kg/m" : "kg"; }

double mass_of(const BodySetup& body) {
  return body.density * body.particle_volume * static_cast<double>(body.position.size() / 3);
}

std::optional<double> exact_mass(const Deck& deck, std::size_t body, double density) {
  const auto volume = exact_volume(deck.bodies[body].shape, deck.domain.dimension);
  if (!volume) return std::nullopt;
  return density * *volume;
}

bool within(const Box& box, const double* x, int dimension) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    if (x[a] < box.lower[a] || x[a] > box.upper[a]) return false;
  }
  return true;
}

/// Particles of a body inside a solid. Those within 1e-4 of a cell of its surface do not count:
/// bodies that share a face may have centres on it.
template <class Solid>
std::int64_t count_inside(const BodySetup& body, const Solid& solid, const Box& box,
                          const Deck& deck) {
  const double margin = 1e-4 * deck.domain.cell_size;
  std::int64_t count = 0;
  for (std::size_t p = 0; p < body.position.size(); p += 3) {
    const double* x = &body.position[p];
    if (within(box, x, deck.domain.dimension) && solid(x) < -margin) ++count;
  }
  return count;
}

std::int64_t count_inside(const BodySetup& body, const ShapeSpec& spec, const Deck& deck) {
  const auto shape = make_shape(spec, deck.domain.dimension);
  const auto solid = [&](const double* x) { return shape->signed_distance(x); };
  return count_inside(body, solid, shape->bounds(), deck);
}

/// With the images of the collider beyond periodic faces.
std::int64_t count_inside(const BodySetup& body, const Collider& collider, const Deck& deck) {
  const auto solid = [&](const double* x) { return collider.distance(x); };
  return count_inside(body, solid, collider.bounds(), deck);
}

std::string particles(std::int64_t count) {
  return fmt::format("{} particle{}", count, count == 1 ? "" : "s");
}

void add_overlaps(const Deck& deck, const SimulationSetup& setup,
                  std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < setup.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < setup.bodies.size(); ++j) {
      // A small body between the particles of a coarse one shows from one side only.
      const BodySetup &first = setup.bodies[i], &second = setup.bodies[j];
      std::int64_t count = count_inside(second, deck.bodies[i].shape, deck);
      const BodySetup& outer = count > 0 ? first : second;
      const BodySetup& inner = count > 0 ? second : first;
      if (count == 0) count = count_inside(first, deck.bodies[j].shape, deck);
      if (count == 0) continue;
      warnings.push_back(
          fmt::format("the bodies {} and {} overlap: {} of {} in {}, where mass counts twice",
                      first.name, second.name, particles(count), inner.name, outer.name));
    }
  }
}

void add_colliders(const Deck& deck, const SimulationSetup& setup,
                   std::vector<std::string>& warnings) {
  for (const ColliderSpec& spec : deck.colliders) {
    const Collider collider(spec, setup.dimension, setup.cell_size, periods_of(setup));
    for (const BodySetup& body : setup.bodies) {
      const std::int64_t count = count_inside(body, collider, deck);
      if (count == 0) continue;
      warnings.push_back(fmt::format("the collider {} holds {} of the body {} at t = 0", spec.name,
                                     particles(count), body.name));
    }
  }
}

void add_masses(const Deck& deck, const SimulationSetup& setup,
                std::vector<std::string>& warnings) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const double mass = mass_of(setup.bodies[b]);
    const auto exact = exact_mass(deck, b, setup.bodies[b].density);
    if (!exact || std::abs(mass - *exact) <= most_missing * *exact) continue;
    warnings.push_back(
        fmt::format("the particles of the body {} have {:.5g} {}, but its shape {:.5g} {}; lower "
                    "domain.cell_size or raise particles_per_direction",
                    setup.bodies[b].name, mass, mass_unit(deck), *exact, mass_unit(deck)));
  }
}

/// Laws that tell no elastic part of their change of volume have all of it averaged.
void add_averages(const Deck& deck, std::vector<std::string>& warnings) {
  if (deck.method.volumetric_locking == VolumetricLocking::none) return;
  for (const MaterialSpec& material : deck.materials) {
    const MaterialEntry* const law = find_material_model(material.model);
    if (law->averaging_doubt == nullptr) continue;
    for (const BodySpec& body : deck.bodies) {
      if (body.material != material.name) continue;
      const std::string doubt =
          law->averaging_doubt(material.input, body.initial_stress.has_value());
      if (doubt.empty()) continue;
      warnings.push_back(fmt::format(
          "method.volumetric_locking = \"fbar\" averages all changes of volume of {}: the material "
          "{} {}; leave it off",
          material.model, material.name, doubt));
      break;
    }
  }
}

}  // namespace

std::string masses_text(const Deck& deck, const SimulationSetup& setup) {
  std::string text;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const BodySetup& body = setup.bodies[b];
    text += fmt::format("{}{} {:.5g} {}", b == 0 ? "" : ", ", body.name, mass_of(body),
                        mass_unit(deck));
    if (const auto exact = exact_mass(deck, b, body.density)) {
      text += fmt::format(" (shape {:.5g})", *exact);
    }
  }
  return text;
}

std::vector<std::string> deck_warnings(const Deck& deck, const SimulationSetup& setup) {
  std::vector<std::string> warnings;
  if (deck.method.kernel == KernelType::linear) {
    warnings.push_back(
        "method.kernel = \"linear\" is there for comparison: its forces do not fade with the mass "
        "of "
        "a node, and particles at the edge of a body that move from cell to cell blow up sooner or "
        "later; use compact or quadratic");
  }
  const double courant = courant_number(setup);
  if (!deck.time.step && deck.time.cfl > TimeSpec{}.cfl && deck.time.cfl > courant) {
    warnings.push_back(
        fmt::format("time.cfl = {:.3g}: with fluids it counts as {:.3g}, or drops "
                    "would come apart",
                    deck.time.cfl, courant));
  }
  add_averages(deck, warnings);
  add_overlaps(deck, setup, warnings);
  add_colliders(deck, setup, warnings);
  add_masses(deck, setup, warnings);
  return warnings;
}

}  // namespace scree
