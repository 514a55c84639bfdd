// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/coupling/coupling_setup.hpp"
#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/pressure_matrix.hpp"

namespace scree {

/// A particle whose faces drain.
template <int D>
struct SurfacePoint {
  PressureNode<D> cell;
  std::array<double, D> xi;  ///< position within the cell, in [0, 1) but at walls
  double mobility;           ///< [m^2/(Pa s)]
  double fluid_density;      ///< [kg/m^3]
};

/// The surfaces on which pore pressure or flux is given. Their faces are carried by their particles
/// and deform with them.
///
/// A pressure is not fixed at nodes, which would be wrong by 13 % on a surface that cuts a cell,
/// but holds weakly, at the surface itself, through a thin layer of the soil's own mobility k:
/// outflow per area C k/h (p - p_given), h the spacing of the pressure nodes. The layer is h/C
/// thick: its error is of first order with a small constant.
template <int D>
class DrainedSurfaces {
 public:
  static constexpr double layers = 100;  ///< C

  /// first_id[b]: id of the first particle of body b.
  DrainedSurfaces(std::vector<DrainageSetup> setups, const std::vector<std::int64_t>& first_id);

  bool empty() const { return faces_.empty(); }

  /// The points are others: place() before the next add().
  void forget() { placed_ = false; }
  /// Finds the faces by their particles' points, if they are not known. find(id): the point of a
  /// particle, nothing if it left; deformation(id): its F since t = 0; h: spacing of the pressure
  /// nodes [m]; lower, cell_size: to turn points into positions.
  template <class Find, class Deformation>
  void place(Find&& find, Deformation&& deformation, double h, double cell_size,
             const PressureLattice<D>& lattice, const std::array<double, 3>& lower) {
    if (placed_) return;
    places_.clear();
    for (const Face& face : faces_) {
      const std::optional<SurfacePoint<D>> p = find(face.id);
      if (!p) continue;
      const Vec3<double> middle = position(*p, lattice, lower, cell_size);
      add_place(face, *p, deformation(face.id), middle, h);
    }
    placed_ = true;
  }
  /// Adds the surfaces' part at time t to the system.
  void add(double t, PressureMatrix<D>& matrix);

  std::size_t count() const { return setups_.size(); }
  /// Adds to each surface's entry of `mass` the water that flowed out over the step dt at the
  /// solved pressures [kg] (2D: kg/m).
  void add_outflow(const PressureMatrix<D>& matrix, const std::vector<double>& pressure, double dt,
                   std::vector<double>& mass) const;

 private:
  struct Face {
    std::int32_t surface;
    std::int64_t id;
    Vec3<double> area, offset;  ///< at t = 0
  };
  /// A face among the points: outflow = sum_k n_k conductance (p_k - given) + flux.
  struct Place {
    std::int32_t surface;
    PressureNode<D> cell;
    double x[3];  ///< [m]
    double area;  ///< [m^2] (2D: m)
    double n[1 << D];
    double conductance, density;
    double given, flux;  ///< as the last add() saw them
  };

  static Vec3<double> position(const SurfacePoint<D>& point, const PressureLattice<D>& lattice,
                               const std::array<double, 3>& lower, double cell_size);
  void add_place(const Face& face, const SurfacePoint<D>& point, const Mat3<double>& deformation,
                 const Vec3<double>& middle, double h);

  std::vector<DrainageSetup> setups_;
  std::vector<Face> faces_;
  std::vector<Place> places_;
  bool placed_ = false;
};

extern template class DrainedSurfaces<2>;
extern template class DrainedSurfaces<3>;

}  // namespace scree
