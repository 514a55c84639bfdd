// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/lone_particle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "materials/registry.hpp"

namespace scree {
namespace {

/// Of an axis at a quarter of a cell from a node, where both lattices are alike and both traces are
/// largest: s = sin(2 pi u)/(2 pi) with u = 1/4, and K(1/4) = 3/4 + s.
constexpr double quarter_sine = 0.5 / std::numbers::pi;
constexpr double quarter_weight = 0.75 + quarter_sine;

/// tr D^-1 with D = q I + s s^T.
double inverse_moment(KernelType kernel, int dimension) {
  if (kernel == KernelType::quadratic) return 4.0 * dimension;
  constexpr double square = quarter_sine * quarter_sine;
  constexpr double q = 3.0 / 16 - quarter_sine / 2 - square;
  return (dimension - 1) / q + 1 / (q + dimension * square);
}

/// Sum of |grad w|^2/w. Quadratic: in the middle between two nodes.
double slope_sum(KernelType kernel, int dimension) {
  if (kernel == KernelType::quadratic) return 6.0 * dimension;
  return dimension / (quarter_weight * (1 - quarter_weight));
}

}  // namespace

double lone_particle_courant(KernelType kernel, TransferType transfer, int dimension) {
  // The slopes of hat functions do not fade with their weights: no step is short enough.
  if (kernel == KernelType::linear) return std::numeric_limits<double>::infinity();
  const double moment = inverse_moment(kernel, dimension);
  const bool remembers = transfer == TransferType::mls || transfer == TransferType::apic;
  const double kick = transfer == TransferType::mls ? moment : slope_sum(kernel, dimension);
  return std::sqrt(2 / (kick - (remembers ? moment / 2 : 0.0)));
}

double courant_number(const SimulationSetup& setup) {
  const bool fluid = std::any_of(setup.bodies.begin(), setup.bodies.end(), [](const auto& body) {
    const MaterialEntry* law = find_material_model(body.model);
    return law && law->fluid;
  });
  if (!fluid) return setup.cfl;
  const double lone = lone_particle_courant(setup.kernel, setup.transfer, setup.dimension);
  return std::min(setup.cfl, (setup.dimension == 3 ? 0.71 : 0.89) * lone);
}

}  // namespace scree
