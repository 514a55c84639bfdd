// SPDX-License-Identifier: Apache-2.0
#include "verification/reference/solver.hpp"

#include <Eigen/Geometry>

namespace scree::reference {

void Solver::step(double dt) {
  Grid grid = scatter();
  grid.update(dt, settings_.gravity, settings_.faces);
  gather(grid, dt);
}

Grid Solver::scatter() const {
  Grid grid(settings_.cell_size);
  for (const Particle& particle : particles_) scatter_particle(particle, grid);
  return grid;
}

void Solver::gather(const Grid& grid, double dt) {
  for (Particle& particle : particles_) gather_particle(grid, dt, particle);
}

void Solver::scatter_particle(const Particle& particle, Grid& grid) const {
  const Settings& s = settings_;
  Matrix inverse_D = Matrix::Zero();
  if (affine()) inverse_D = inverse_moment_matrix(s.kernel, particle.x, s.cell_size, s.dimension);
  for (const StencilEntry& entry : stencil(s.kernel, particle.x, s.cell_size, s.dimension)) {
    GridNode& node = grid.nodes()[entry.node];
    node.mass += entry.weight * particle.mass;
    Vector velocity = particle.v;
    if (affine()) velocity += particle.B * inverse_D * entry.offset;
    node.momentum += entry.weight * particle.mass * velocity;
    const Matrix stress = particle.volume * particle.state.tau;
    if (s.transfer == Transfer::mls)
      node.force -= entry.weight * stress * inverse_D * entry.offset;
    else
      node.force -= stress * entry.gradient;
  }
}

void Solver::gather_particle(const Grid& grid, double dt, Particle& particle) const {
  const Settings& s = settings_;
  const double share = 1.0 / lattice_count(s.kernel);
  Vector velocity = Vector::Zero(), change = Vector::Zero();
  Matrix B = Matrix::Zero(), L = Matrix::Zero();
  for (const StencilEntry& entry : stencil(s.kernel, particle.x, s.cell_size, s.dimension)) {
    const GridNode node = grid.at(entry.node, s.faces);
    velocity += share * entry.weight * node.velocity;
    change += share * entry.weight * (node.velocity - node.velocity_before);
    B += share * entry.weight * node.velocity * entry.offset.transpose();
    L += share * node.velocity * entry.gradient.transpose();
  }
  if (s.transfer == Transfer::mls)
    L = B * inverse_moment_matrix(s.kernel, particle.x, s.cell_size, s.dimension);
  if (s.transfer == Transfer::flip)
    particle.v = s.flip_blend * (particle.v + change) + (1 - s.flip_blend) * velocity;
  else
    particle.v = velocity;
  if (affine()) particle.B = B;
  particle.x += dt * velocity;
  if (particle.material != nullptr) particle.material->advance(particle.state, L, dt);
}

Vector Solver::momentum() const {
  Vector sum = Vector::Zero();
  for (const Particle& particle : particles_) sum += particle.mass * particle.v;
  return sum;
}

Vector Solver::angular_momentum(bool with_affine) const {
  Vector sum = Vector::Zero();
  for (const Particle& particle : particles_) {
    sum += particle.x.cross(particle.mass * particle.v);
    if (!with_affine) continue;
    const Matrix& B = particle.B;
    sum += particle.mass * Vector(B(2, 1) - B(1, 2), B(0, 2) - B(2, 0), B(1, 0) - B(0, 1));
  }
  return sum;
}

Matrix affine_matrix(const Settings& settings, const Vector& x, const Matrix& L) {
  return L * moment_matrix(settings.kernel, x, settings.cell_size, settings.dimension);
}

}  // namespace scree::reference
