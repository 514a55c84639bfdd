// SPDX-License-Identifier: Apache-2.0
#include "app/coupling_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/material_point.hpp"
#include "solver/deck/initial_stress.hpp"
#include "solver/particles/shape.hpp"

namespace scree {
namespace {

double height(const Deck& deck, const BodySpec& body) {
  const Box box = make_shape(body.shape, deck.domain.dimension)->bounds();
  const int axis = gravity_axis(deck);
  double longest = 0;
  for (std::size_t a = 0; a < std::size_t(deck.domain.dimension); ++a) {
    if (axis < 0 || int(a) == axis) longest = std::max(longest, box.upper[a] - box.lower[a]);
  }
  return longest;
}

/// The law's point in the state of the body's middle.
std::unique_ptr<MaterialPoint> point_of(const Deck& deck, const BodySpec& body,
                                        const MaterialSpec& material) {
  auto point =
      make_material_point(material.model, material.input, material.density, deck.domain.dimension);
  if (!body.initial_stress) return point;
  const Box box = make_shape(body.shape, deck.domain.dimension)->bounds();
  std::vector<double> middle;
  for (std::size_t a = 0; a < 3; ++a) {
    middle.push_back(a < std::size_t(deck.domain.dimension) ? 0.5 * (box.lower[a] + box.upper[a])
                                                            : 0.0);
  }
  point->set_entries(solve_initial_states(deck, body, middle).states.front());
  return point;
}

}  // namespace

std::vector<std::string> coupling_report(const Deck& deck) {
  std::vector<std::string> lines;
  if (!deck.coupling) return lines;
  for (const BodySpec& body : deck.bodies) {
    const MaterialSpec& material = *deck.find_material(body.material);
    const auto pores = material.pores();
    if (!pores) continue;
    const double speed = point_of(deck, body, material)->wave_speed();
    const double modulus = material.density * speed * speed;
    const double storage =
        storage_at(*pores, pores->porosity) + pores->biot * pores->biot / modulus;
    const double cv = pores->mobility / storage;
    const double h = height(deck, body);
    const double bound = deck.time.cfl * deck.domain.cell_size / speed;
    lines.push_back(fmt::format(
        "{}: k {:.4g} m^2/(Pa s), c_v {:.4g} m^2/s, consolidation time H^2/c_v {:.4g} s (H {:.4g} "
        "m), step at most {:.4g} s (drained soil)",
        body.name, pores->mobility, cv, cv > 0 ? h * h / cv : 1e300, h, bound));
    if (cv <= 0)
      lines.back() = fmt::format("{}: k 0, undrained; step at most {:.4g} s", body.name, bound);
  }
  return lines;
}

}  // namespace scree
