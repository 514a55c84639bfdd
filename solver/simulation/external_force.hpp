// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/boundary/traction.hpp"
#include "solver/io/state_archive.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// Forces per mass on single particles: body forces and tractions. Evaluated once a step at the
/// step's start, particle by particle.
class ExternalForce {
 public:
  using BodyForce = std::function<std::array<double, 3>(const double*, const double*, double)>;

  /// first_id[b]: id of the first particle of body b; mass[b]: its particles' mass [kg].
  ExternalForce(BodyForce body_force, const std::vector<TractionSetup>& tractions, int dimension,
                const std::vector<std::int64_t>& first_id, const std::vector<double>& mass,
                std::int64_t particles);

  /// Follows the total deformation of a loaded particle: F <- (I + increment) F.
  void deform(std::int64_t id, const Mat3<double>& increment);
  bool has_tractions() const { return !loads_.empty(); }
  /// Whether particles without a traction are free of forces.
  bool tractions_only() const { return !body_force_; }
  std::vector<std::int64_t> loaded_ids() const;  ///< ascending
  bool loaded(std::int64_t id) const { return first_load_[std::size_t(id)] >= 0; }

  /// Acceleration of particle `id` at reference position X and position x [m/s^2].
  std::array<double, 3> acceleration(std::int64_t id, const double* X, const double* x,
                                     double t) const;

  /// Moment of the tractions about the particle: sum over its faces of the force times the place of
  /// the face, from the particle [N m]. `half`: half the particle's side at t = 0 [m].
  Mat3<double> moment(std::int64_t id, const double* X, const double* x, double t,
                      double half) const;

  void save(StateWriter& writer) const;
  void load(const StateReader& reader);

 private:
  struct Load {
    std::int32_t traction;
    std::int32_t next;  ///< next load of the same particle, -1 = none
    Vec3<double> area_vector;
    double area;
    double mass;
    Mat3<double> F;
  };

  BodyForce body_force_;
  std::vector<Traction> tractions_;
  std::vector<Load> loads_;
  std::vector<std::int32_t> first_load_;  ///< by id, -1 = none
};

}  // namespace scree
