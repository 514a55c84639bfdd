// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "materials/material_point.hpp"
#include "solver/element/motion.hpp"

namespace scree {

/// Cauchy stress of a point, tension positive [Pa].
Sym3<double> cauchy_stress(const MaterialPoint& point);

/// Why a point is not admissible, a clause: `what` cannot be represented, or no voids are left.
std::string inadmissible_cause(const MaterialPoint& point, const std::string& what);

/// The held component of a Cauchy stress, compression positive.
double held_component(const Sym3<double>& cauchy, HeldStress held);

/// How a step under a held stress ended.
struct HeldOutcome {
  bool converged = false;
  double free = 0;      ///< the free logarithmic stretch found, or the best one
  double stress = 0;    ///< the held component there
  int evaluations = 0;  ///< of the law
  std::string cause;    ///< why it did not converge, a clause
};

/// A step from `from` to the control of `to` whose free stretch gives the wanted stress: to 1e-10
/// of it (or of the largest stress, or to rounding). The point stays in the new state, or, without
/// convergence, in the old one.
///
/// Newton's method with the derivative from a difference, inside a bracket once the residual has
/// changed its sign: yield makes the stress a function with kinks, but it grows with compression.
class HeldStep {
 public:
  /// `density` [kg/m^3] of the undeformed material, `dt` [s] of the step.
  HeldStep(MaterialPoint& point, const Motion& motion, HeldStress held, double density, double dt)
      : point_(point), motion_(motion), held_(held), density_(density), dt_(dt) {}

  /// `guess` is where the search for the free stretch starts.
  HeldOutcome take(const PathState& from, double control, double wanted, double guess);

 private:
  struct Trial {
    double residual = 0;   ///< Pa
    double tolerance = 0;  ///< Pa
    bool usable = false;   ///< the law can represent the state
  };
  /// Free stretches between which the residual changes its sign.
  struct Bracket {
    double low = -std::numeric_limits<double>::infinity();  ///< too compressed there
    double high = std::numeric_limits<double>::infinity();  ///< not enough
    bool closed() const { return low > -1e300 && high < 1e300; }
  };

  bool search(double guess, HeldOutcome& best);
  Trial evaluate(double free);
  double next(double free, const Trial& trial, int iteration);

  MaterialPoint& point_;
  const Motion& motion_;
  HeldStress held_;
  double density_, dt_;
  double rounding_ = 0;  ///< of a stress [Pa]
  std::vector<double> saved_;
  PathState from_;
  Bracket bracket_;
  double control_ = 0, wanted_ = 0;
  int evaluations_ = 0;
};

}  // namespace scree
