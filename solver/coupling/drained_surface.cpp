// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/drained_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
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
      f.F = identity3<double>();
      if (first_.size() <= std::size_t(f.id)) first_.resize(std::size_t(f.id) + 1, -1);
      f.next = first_[std::size_t(f.id)];
      first_[std::size_t(f.id)] = std::int32_t(faces_.size());
      faces_.push_back(f);
    }
    setups_[s].faces.clear();
  }
}

template <int D>
bool DrainedSurfaces<D>::carries(std::int64_t id) const {
  return std::size_t(id) < first_.size() && first_[std::size_t(id)] >= 0;
}

template <int D>
void DrainedSurfaces<D>::deform(std::int64_t id, const Mat3<double>& increment) {
  for (std::int32_t f = first_[std::size_t(id)]; f >= 0; f = faces_[std::size_t(f)].next) {
    Mat3<double>& F = faces_[std::size_t(f)].F;
    F = F + increment * F;
  }
}

template <int D>
void DrainedSurfaces<D>::add(const FlowPoints<D>& points, const std::vector<std::int32_t>& point_of,
                             double t, double h, double cell_size,
                             const PressureLattice<D>& lattice, const std::array<double, 3>& lower,
                             PressureMatrix<D>& matrix) {
  constexpr int corners = 1 << D;
  places_.clear();
  for (const Face& face : faces_) {
    const std::int32_t index = point_of[std::size_t(face.id)];
    if (index < 0) continue;
    const FlowPoint<D>& p = points.points[std::size_t(index)];
    const Vec3<double> offset = face.F * face.offset;
    const double area = norm(cofactor(face.F) * face.area);
    double x[3] = {}, xi[D];
    for (int a = 0; a < D; ++a) {
      // The hats of the particle's own cell, extended: no node is used that has no particle.
      xi[a] = p.xi[a] + offset[a] / h;
      x[a] =
          lower[std::size_t(a)] + offset[a] +
          cell_size * (lattice.spacing() * (p.cell[std::size_t(a)] + p.xi[a]) + lattice.offset());
    }
    const DrainageSetup& setup = setups_[std::size_t(face.surface)];
    const double value = setup.value ? setup.value(x, t) : 0.0;
    if (!std::isfinite(value)) {
      throw RunFault(
          fmt::format("drainage.{}: its value is not finite at t = {:.6g} s", setup.name, t));
    }
    Place place{};
    place.cell = p.cell;
    hats<D>(xi, place.n);
    const bool flux = setup.type == DrainageType::flux;
    place.conductance = flux ? 0.0 : layers * p.mobility / h * area;
    place.given = flux ? 0.0 : value;
    place.flux = flux ? value * area : 0.0;
    place.density = p.fluid_density;
    places_.push_back(place);
    for (int j = 0; j < corners; ++j) {
      const PressureNode<D> from = corner<D>(p.cell, j);
      const std::int32_t row = matrix.row(from);
      matrix.rhs()[std::size_t(row)] += place.n[j] * (place.conductance * place.given - place.flux);
      for (int l = 0; l < corners; ++l) {
        matrix.add(row, matrix.offset_index(from, corner<D>(p.cell, l)),
                   place.conductance * place.n[j] * place.n[l]);
      }
    }
  }
}

template <int D>
double DrainedSurfaces<D>::outflow(const PressureMatrix<D>& matrix,
                                   const std::vector<double>& pressure, double dt) const {
  double sum = 0;
  for (const Place& place : places_) {
    double p = 0;
    for (int k = 0; k < (1 << D); ++k) {
      p += place.n[k] * pressure[std::size_t(matrix.row(corner<D>(place.cell, k)))];
    }
    sum += place.density * (place.conductance * (p - place.given) + place.flux);
  }
  return sum * dt;
}

template <int D>
void DrainedSurfaces<D>::save(StateWriter& writer) const {
  std::vector<double> entries;
  for (const Face& face : faces_) {
    for (int i = 0; i < 9; ++i) entries.push_back(face.F(i / 3, i % 3));
  }
  writer.put("coupling/faces", entries);
}

template <int D>
void DrainedSurfaces<D>::load(const StateReader& reader) {
  const std::vector<double> entries = reader.get<double>("coupling/faces");
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (int i = 0; i < 9; ++i) faces_[f].F(i / 3, i % 3) = entries.at(9 * f + std::size_t(i));
  }
}

template class DrainedSurfaces<2>;
template class DrainedSurfaces<3>;

}  // namespace scree
