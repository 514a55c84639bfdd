// SPDX-License-Identifier: Apache-2.0
//
// The reference method: one explicit MPM step as the method page writes it, split into scatter,
// grid update and gather.
#pragma once

#include <vector>

#include "verification/reference/grid.hpp"
#include "verification/reference/material.hpp"

namespace scree::reference {

enum class Transfer { mls, apic, flip, pic };

struct Particle {
  Vector x = Vector::Zero();  ///< m, from the domain's lower corner; z = 0 in 2D
  Vector v = Vector::Zero();  ///< m/s
  Matrix B = Matrix::Zero();  ///< 1/n sum w v_i (x_i - x_p)^T [m^2/s]; used by mls and apic
  double mass = 1;            ///< kg (per metre of thickness in 2D)
  double volume = 1;          ///< reference volume [m^3]
  const Material* material = nullptr;  ///< null: no stress other than state.tau
  MaterialState state;
};

struct Settings {
  int dimension = 3;
  double cell_size = 1;  ///< m
  Kernel kernel = Kernel::compact;
  Transfer transfer = Transfer::mls;
  double flip_blend = 1;  ///< flip: share of the old velocity plus grid change, the rest is pic
  Vector gravity = Vector::Zero();
  std::vector<Face> faces;
};

class Solver {
 public:
  explicit Solver(Settings settings) : settings_(std::move(settings)) {}

  std::vector<Particle>& particles() { return particles_; }
  const std::vector<Particle>& particles() const { return particles_; }
  const Settings& settings() const { return settings_; }

  /// scatter, update with dt [s], gather.
  void step(double dt);

  /// Mass, momentum (with the affine part for mls and apic) and force of all particles on the grid.
  Grid scatter() const;
  /// Velocity, B, position, state and stress of all particles from updated nodes.
  void gather(const Grid& grid, double dt);

  /// Sum of m v [kg m/s].
  Vector momentum() const;
  /// Sum of x cross m v about the lower corner; `with_affine` adds m eps_abc B_cb [kg m^2/s].
  Vector angular_momentum(bool with_affine) const;

 private:
  bool affine() const {
    return settings_.transfer == Transfer::mls || settings_.transfer == Transfer::apic;
  }
  void scatter_particle(const Particle& particle, Grid& grid) const;
  void gather_particle(const Grid& grid, double dt, Particle& particle) const;

  Settings settings_;
  std::vector<Particle> particles_;
};

/// B = L D(x) of a particle that moves with the velocity gradient L [1/s].
Matrix affine_matrix(const Settings& settings, const Vector& x, const Matrix& L);

}  // namespace scree::reference
