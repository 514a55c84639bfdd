// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "postproc/colliders/surface_mesh.hpp"
#include "postproc/run/run.hpp"
#include "solver/boundary/collider_spec.hpp"

namespace scree {

/// A collider of a run's deck with its way over time.
class RunCollider {
 public:
  /// \param times at which it will be asked for, s, ascending \throws UserError
  RunCollider(const Run& run, ColliderSpec spec, const std::vector<double>& times);

  const std::string& name() const { return spec_.name; }
  bool moves() const { return moves_; }
  bool terrain() const;
  /// Since t = 0 at the k-th of the times, m.
  const std::array<double, 3>& displacement(std::size_t k) const { return displacement_[k]; }
  /// What viewers draw, where the collider stands at the k-th of the times. \throws UserError
  SurfaceMesh surface(std::size_t k) const;

 private:
  ColliderSpec spec_;
  int dimension_;
  std::array<double, 3> lower_, upper_;  ///< of the domain, m
  bool moves_;
  std::vector<std::array<double, 3>> displacement_;
  mutable std::optional<SurfaceMesh> at_start_;
};

/// The colliders of the run's deck, in its order. Throws UserError where the deck cannot be read
/// any more or a file of geometry has gone.
std::vector<RunCollider> run_colliders(const Run& run, const std::vector<double>& times);

}  // namespace scree
