// SPDX-License-Identifier: Apache-2.0
//
// Pore pressure of the reference method: sums over particles, no matrix, conjugate gradients
// without a preconditioner. Shares no code with the solver.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <vector>

#include "verification/reference/kernel.hpp"

namespace scree::reference {

/// A particle with water in its pores; SI. Its box is a cube of its volume (2D: a square).
struct PorePoint {
  Vector position = Vector::Zero(), velocity = Vector::Zero();
  double mass = 0, volume = 0;
  double storage = 0;   ///< 1/M [1/Pa]
  double mobility = 0;  ///< [m^2/(Pa s)]
  double biot = 1;
  double fluid_density = 1000;
  double pressure = 0;  ///< before the step
};

/// One step of the pore pressure on free particles (no walls) whose only other force is gravity.
class PressureStep {
 public:
  using Field = std::map<std::array<int, 3>, double>;  ///< by pressure node

  /// Pressure nodes at (i spacing + offset) cells; affine: mls, else the gradient of the weights.
  PressureStep(Kernel kernel, bool affine, int dimension, double cell_size, int spacing,
               double offset, std::vector<PorePoint> points);

  /// The pressures of the step's end at the particles, to a relative residual of `tolerance`.
  std::vector<double> solve(double dt, const Vector& gravity, double tolerance);

  /// The system's matrix times p, and its right-hand side.
  Field apply(double dt, const Field& p) const;
  Field rhs(double dt, const Vector& gravity) const;
  /// Nodal forces of a pressure field.
  std::map<Node, Vector> force(const Field& p) const;
  const Field& nodes() const { return nodes_; }  ///< all that are touched, zero

 private:
  struct Hat {
    std::array<int, 3> node;
    double value;
    Vector slope;
  };
  using Cell = std::array<int, 3>;
  /// A point of Gauss' quadrature of the box.
  struct FlowPoint {
    double share;  ///< of the particle's volume
    std::vector<Hat> hats;
  };
  /// What a particle touches.
  struct Touch {
    std::vector<StencilEntry> nodes;
    std::vector<Vector> gradient;  ///< of each node, as the transfer's force takes it
    std::vector<Hat> hats;
    std::vector<FlowPoint> flow;
  };
  Cell cell_of(const Vector& x) const;
  std::vector<Hat> hats(const Cell& cell, const Vector& x) const;
  std::vector<FlowPoint> flow_points(const PorePoint& point) const;
  Vector gradient(const StencilEntry& entry, const Vector& x) const;
  static double interpolate(const Field& p, const Touch& touch);
  double divergence(const std::map<Node, Vector>& velocity, const Touch& touch) const;

  Kernel kernel_;
  bool affine_;
  int dimension_;
  double cell_size_;
  double spacing_, offset_;
  std::vector<PorePoint> points_;
  std::vector<Touch> touch_;  ///< of each point
  std::set<Cell> occupied_;   ///< pressure cells with a particle
  std::map<Node, double> mass_;
  Field nodes_;
};

}  // namespace scree::reference
