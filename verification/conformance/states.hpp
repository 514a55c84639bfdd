// SPDX-License-Identifier: Apache-2.0
/// \file
/// States and paths on which the properties of the laws are tested.
#pragma once

#include <functional>
#include <optional>

#include "verification/conformance/law.hpp"
#include "verification/support/lanes_testing.hpp"

namespace scree::testing {

using State = Entries<double>;

/// One step; dt [s].
inline Sym3<double> advance(const Law& law, State& state, const Eigen::Matrix3d& increment,
                            double dt = 0.01) {
  return law.exact->kirchhoff(state, from_eigen<double>(increment), dt);
}

/// Stress without the part from the rate of deformation.
inline Sym3<double> stress_at_rest(const Law& law, State state) {
  return law.exact->kirchhoff(state, zero3<double>(), 1.0);
}

/// State after 5 random increments of this size; yields where the law yields.
State random_state(const Law& law, MatrixSource& source, double size);

/// The same with a size anywhere between 1e-4 and `largest`.
State state_of_any_size(const Law& law, MatrixSource& source, double largest);

/// A compressed, sheared and turned state; nothing where a yield surface is near, so that small
/// steps from here are elastic.
std::optional<State> elastic_state(const Law& law, MatrixSource& source);

/// The state seen from a turned frame: 9 components are F -> Q F, 6 components A -> Q A Q^T.
State turned(const Law& law, const State& state, const Eigen::Matrix3d& q);

/// The state of a body that had been turned before it was deformed: F -> F Q.
State turned_before(const Law& law, const State& state, const Eigen::Matrix3d& q);

/// Largest stiffness and stress of a state [Pa]: what errors of stress are relative to. (Clay is
/// stiffer the more it is compressed.)
double stress_scale(const Law& law, const State& state, const Sym3<double>& stress);

/// Gradients with singular values in [0.3, 3], among them two and three equal ones and the
/// identity.
Eigen::Matrix3d strong_gradient(MatrixSource& source);

/// Largest of |a_i - b_i|/(1 + |a_i|).
double distance_of_entries(const State& a, const State& b);

/// A smooth path of deformation, F(0) = I, with the rate zero at t = 0 and t = 1.
using Path = std::function<Eigen::Matrix3d(double t)>;
Path loop(MatrixSource& source, double size);     ///< F(1) = I
Path one_way(MatrixSource& source, double size);  ///< ends elsewhere

/// Follows a path in equal steps of t within one second; `visit` sees each increment, and the
/// stress after it.
void follow(const Law& law, State& state, const Path& path, int steps,
            const std::function<void(const Eigen::Matrix3d&, const Sym3<double>&)>& visit = {});

}  // namespace scree::testing
