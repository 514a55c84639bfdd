// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/coupling/coupling_setup.hpp"
#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/pressure_matrix.hpp"
#include "solver/io/state_archive.hpp"

namespace scree {

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

  /// The face's particle's deformation over the last step: F <- (I + increment) F.
  void deform(std::int64_t id, const Mat3<double>& increment);
  bool carries(std::int64_t id) const;

  /// Where the particles of the faces are: index into the points by id, -1 if it left.
  /// Adds the surfaces' part at time t to the system; h: spacing of the pressure nodes [m];
  /// lower, cell_size: to turn points into positions.
  void add(const FlowPoints<D>& points, const std::vector<std::int32_t>& point_of, double t,
           double h, double cell_size, const PressureLattice<D>& lattice,
           const std::array<double, 3>& lower, PressureMatrix<D>& matrix);

  /// Mass of water that flowed out over the step dt at the solved pressures [kg] (2D: kg/m).
  double outflow(const PressureMatrix<D>& matrix, const std::vector<double>& pressure,
                 double dt) const;

  void save(StateWriter& writer) const;
  void load(const StateReader& reader);

 private:
  struct Face {
    std::int32_t surface;
    std::int32_t next;  ///< of the same particle, -1: last
    std::int64_t id;
    Vec3<double> area, offset;  ///< at t = 0
    Mat3<double> F;
  };
  /// A face as the last add() saw it: outflow = sum_k n_k conductance (p_k - given) + flux.
  struct Place {
    PressureNode<D> cell;
    double n[1 << D];
    double conductance, given, flux, density;
  };

  std::vector<DrainageSetup> setups_;
  std::vector<Face> faces_;
  std::vector<std::int32_t> first_;  ///< by id: its first face, -1: none
  std::vector<Place> places_;
};

extern template class DrainedSurfaces<2>;
extern template class DrainedSurfaces<3>;

}  // namespace scree
