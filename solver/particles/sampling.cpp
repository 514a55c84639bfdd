// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/sampling.hpp"

#include <cmath>
#include <string>

#include "solver/base/error.hpp"

namespace scree {

namespace {

/// Beyond this many sites (32 GiB of bits alone) a deck has a wrong unit, not a large body.
constexpr double most_sites = 2.5e11;

/// By how much of a spacing the inside test is moved: decides for centres that lie on a surface.
/// Far above rounding of coordinates (1e-16 of up to 1e6 spacings), far below any feature. The
/// axes differ so that no common diagonal is its own image.
constexpr double nudge[3] = {1e-5, 0.618e-5, 0.382e-5};

struct SiteBox {
  std::array<std::int64_t, 3> first{0, 0, 0};
  std::array<std::int64_t, 3> count{1, 1, 1};
};

/// All sites whose centres can lie in `box`, with one to spare against rounding.
SiteBox sites_of(const Box& box, const SampleLattice& lattice) {
  if (!box.bounded(lattice.dimension))
    throw UserError("an unbounded shape cannot be filled with particles; intersect it with a box");
  SiteBox sites;
  double total = 1;
  for (int a = 0; a < lattice.dimension; ++a) {
    const double lower = std::floor((box.lower[a] - lattice.lower[a]) / lattice.spacing) - 1;
    const double upper = std::ceil((box.upper[a] - lattice.lower[a]) / lattice.spacing) + 1;
    total *= upper - lower;
    if (!(total < most_sites))
      throw UserError(
          "the bounds of a body hold more than 2.5e11 particle sites; check its lengths "
          "against domain.cell_size");
    sites.first[a] = static_cast<std::int64_t>(lower);
    sites.count[a] = static_cast<std::int64_t>(upper - lower);
  }
  return sites;
}

/// Calls f(i, j, k) for all sites, x fastest.
template <class F>
void for_each_site(const SiteBox& box, F f) {
  for (std::int64_t k = box.first[2]; k < box.first[2] + box.count[2]; ++k)
    for (std::int64_t j = box.first[1]; j < box.first[1] + box.count[1]; ++j)
      for (std::int64_t i = box.first[0]; i < box.first[0] + box.count[0]; ++i) f(i, j, k);
}

}  // namespace

SampledBody sample(const Shape& shape, const std::array<double, 3>& domain_lower, double cell_size,
                   int particles_per_direction, int dimension) {
  SampledBody body;
  body.spacing = cell_size / particles_per_direction;
  body.lattice = {domain_lower, body.spacing, dimension};
  body.particle_volume = std::pow(body.spacing, dimension);
  const SampleLattice& lattice = body.lattice;

  const SiteBox box = sites_of(shape.bounds(), lattice);
  SiteSet filled(box.first, box.count);
  for_each_site(box, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    double x[3] = {0, 0, 0};
    const std::int64_t site[3] = {i, j, k};
    for (int a = 0; a < dimension; ++a)
      x[a] = lattice.coordinate(a, site[a]) + nudge[a] * lattice.spacing;
    if (shape.inside(x)) filled.insert(i, j, k);
  });

  // The exact size first: doubling a growing array would need the memory of large bodies twice.
  body.position.reserve(3 * static_cast<std::size_t>(filled.size()));
  for_each_site(box, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    if (!filled.contains(i, j, k)) return;
    body.position.push_back(lattice.coordinate(0, i));
    body.position.push_back(lattice.coordinate(1, j));
    body.position.push_back(dimension == 3 ? lattice.coordinate(2, k) : 0.0);
  });
  return body;
}

}  // namespace scree
