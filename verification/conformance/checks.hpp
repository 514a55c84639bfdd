// SPDX-License-Identifier: Apache-2.0
/// \file
/// The properties that every law must have, as functions that return the worst error found. The
/// tests assert it small for the laws of the list and large for laws that are wrong on purpose.
/// (That tau is symmetric is a matter of its type.)
#pragma once

#include <string>
#include <vector>

#include "verification/conformance/states.hpp"

namespace scree::testing {

/// Largest error over a number of samples; infinite if any was not a number.
struct Worst {
  double error = 0;
  int samples = 0;
  int large = 0;  ///< errors above 1e-4
  void add(double e);
  void add(const Worst& other);
};

// ---- frames and volume (checks_frame.cpp) ----

/// L = 0 with dt = 0 after a step: change of stress and state.
Worst change_without_strain(const Law& law, MatrixSource& source, int count);
/// A superposed rotation of state and increment must turn the stress, F -> Q F, tau -> Q tau Q^T,
/// and leave energy, volume and wave speed alone; a rotation as an increment must do the same.
Worst loss_of_objectivity(const Law& law, MatrixSource& source, int count);
/// A rotation before the deformation, F -> F Q, must change nothing.
Worst loss_of_isotropy(const Law& law, MatrixSource& source, int count);
/// volume_ratio against the product of det(I + L); fluids may integrate J <- J (1 + tr L).
Worst loss_of_volume(const Law& law, MatrixSource& source, int steps);

// ---- energy (checks_energy.cpp) ----

/// Stress power against the derivative of energy_density, where steps are elastic.
Worst energy_derivative(const Law& law, MatrixSource& source, int count);
/// Work of the stress on closed paths minus the change of energy, over the stiffness: the least
/// value and the largest. Dissipation is never negative, and zero for a hyperelastic law.
struct Dissipation {
  double least = 0, most = 0;
};
Dissipation dissipation(const Law& law, MatrixSource& source, int paths);
/// Deviation from linear elasticity with the moduli of the input at strain e, over e^2 and the
/// stiffness; no samples where the law has no such limit.
Worst small_strain(const Family& family, const std::any& input, MatrixSource& source, int count);

// ---- return maps (checks_return.cpp) ----

/// After strong and degenerate increments, with floating-point exceptions trapped.
struct Returned {
  Worst repeated;   ///< change of stress and state when the return is repeated
  Worst outside;    ///< yield value above 0; not of laws with explicit hardening, whose
                    ///< surface moves after the return by the size of the step
  int flowing = 0;  ///< samples whose elastic part is not (I + L) F
};
template <class T>
Returned strong_returns(const Law& law, MatrixSource& source, int count);
/// True if a first step to the gradient f (det f <= 0) leaves an inadmissible state, with traps
/// armed; a fluid that sees tr L only may live with it.
bool refuses(const Law& law, const Eigen::Matrix3d& f);
/// The entry equivalent_plastic_strain against sqrt(2/3) |deviator of the plastic strain
/// increment| from the elastic gradients; no samples where a law lacks one of them.
Worst plastic_strain(const Law& law, MatrixSource& source, int count);
/// Differences of the final stress between n and 2 n, 2 n and 4 n steps, over the stiffness, mean
/// of paths.
struct Halving {
  double coarse = 0, fine = 0;
};
Halving halving(const Law& law, MatrixSource& source, int paths, int n = 32);

// ---- numbers (checks_numbers.cpp) ----

/// Lanes against scalars: stress, state, wave speed, energy and volume.
template <class T>
Worst lanes_against_scalars(const Law& law, const LaneLaw<T>& lanes, int width,
                            MatrixSource& source, int count);
/// One step in single against double precision.
Worst single_against_double(const Law& law, MatrixSource& source, int count);
/// Number keys of the schema that change neither stress nor state in any sample of the family.
std::vector<std::string> idle_keys(const Family& family, MatrixSource& source);

// ---- waves (checks_wave.cpp) ----

/// How far the stiffness w.A(n)w of the acoustic tensor, along random motions w and directions n,
/// exceeds the bound rho c^2, over the bound. States of strains up to `size`; those of a law with
/// a yield surface include flow.
Worst wave_speed_excess(const Law& law, MatrixSource& source, double size, int count);
/// Bound over the fastest of the waves in random directions, in elastic states near rest.
Worst wave_speed_looseness(const Law& law, MatrixSource& source, int count);

}  // namespace scree::testing
