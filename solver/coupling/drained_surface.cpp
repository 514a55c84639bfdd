// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/drained_surface.hpp"

#include <fmt/format.h>

#include <cmath>

#include "solver/base/error.hpp"

namespace scree {

template <int D>
DrainedSurfaces<D>::DrainedSurfaces(std::vector<DrainageSetup> setups,
                                    const std::vector<std::int64_t>& first_id)
    : setups_(std::move(setups)) {
  for (std::size_t s = 0; s < setups_.size(); ++s) {
    for (const DrainedFace& face : setups_[s].faces) {
      Face f;
      f.surface = std::int32_t(s);
      f.id = first_id[std::size_t(setups_[s].body)] + face.particle;
      for (int a = 0; a < 3; ++a) {
        f.area[a] = face.area[std::size_t(a)];
        f.offset[a] = face.offset[std::size_t(a)];
      }
      faces_.push_back(f);
    }
    setups_[s].faces.clear();
  }
}

template <int D>
Vec3<double> DrainedSurfaces<D>::position(const SurfacePoint<D>& point,
                                          const PressureLattice<D>& lattice,
                                          const std::array<double, 3>& lower, double cell_size) {
  Vec3<double> x{};
  for (int a = 0; a < D; ++a) {
    const double cells =
        lattice.spacing() * (point.cell[std::size_t(a)] + point.xi[std::size_t(a)]) +
        lattice.offset();
    x[a] = lower[std::size_t(a)] + cell_size * cells;
  }
  return x;
}

template <int D>
void DrainedSurfaces<D>::add_place(const Face& face, const SurfacePoint<D>& point,
                                   const Mat3<double>& deformation, const Vec3<double>& middle,
                                   double h) {
  const Vec3<double> offset = deformation * face.offset;
  Place place{};
  place.surface = face.surface;
  place.cell = point.cell;
  place.area = norm(cofactor(deformation) * face.area);
  double xi[D];
  for (int a = 0; a < D; ++a) {
    // The hats of the particle's own cell, extended: no node is used that has no particle.
    xi[a] = point.xi[std::size_t(a)] + offset[a] / h;
    place.x[a] = middle[a] + offset[a];
  }
  hats<D>(xi, place.n);
  const bool flux = setups_[std::size_t(face.surface)].type == DrainageType::flux;
  place.conductance = flux ? 0.0 : layers * point.mobility / h * place.area;
  place.density = point.fluid_density;
  places_.push_back(place);
}

template <int D>
void DrainedSurfaces<D>::add(double t, PressureMatrix<D>& matrix) {
  constexpr int corners = 1 << D;
  for (Place& place : places_) {
    const DrainageSetup& setup = setups_[std::size_t(place.surface)];
    const double value = setup.value ? setup.value(place.x, t) : 0.0;
    if (!std::isfinite(value)) {
      throw RunFault(
          fmt::format("drainage.{}: its value is not finite at t = {:.6g} s", setup.name, t));
    }
    const bool flux = setup.type == DrainageType::flux;
    place.given = flux ? 0.0 : value;
    place.flux = flux ? value * place.area : 0.0;
    for (int j = 0; j < corners; ++j) {
      const PressureNode<D> from = corner<D>(place.cell, j);
      const std::int32_t row = matrix.row(from);
      matrix.rhs()[std::size_t(row)] += place.n[j] * (place.conductance * place.given - place.flux);
      for (int l = 0; l < corners; ++l) {
        matrix.add(row, matrix.offset_index(from, corner<D>(place.cell, l)),
                   place.conductance * place.n[j] * place.n[l]);
      }
    }
  }
}

template <int D>
void DrainedSurfaces<D>::add_outflow(const PressureMatrix<D>& matrix,
                                     const std::vector<double>& pressure, double dt,
                                     std::vector<double>& mass) const {
  for (const Place& place : places_) {
    double p = 0;
    for (int k = 0; k < (1 << D); ++k) {
      p += place.n[k] * pressure[std::size_t(matrix.row(corner<D>(place.cell, k)))];
    }
    mass[std::size_t(place.surface)] +=
        dt * place.density * (place.conductance * (p - place.given) + place.flux);
  }
}

template class DrainedSurfaces<2>;
template class DrainedSurfaces<3>;

}  // namespace scree
