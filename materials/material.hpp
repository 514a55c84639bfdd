// SPDX-License-Identifier: Apache-2.0
/// \file
/// The contract of a material law. A law is a struct without data, in one header, plus one line in
/// materials/list.def; parsing, output, checkpoints and the conformance tests follow from that.
#pragma once

#include <concepts>
#include <string>
#include <type_traits>
#include <vector>

#include "solver/base/schema.hpp"
#include "solver/base/tensor.hpp"

namespace scree {

/// One quantity in the state of a particle, in the order of the members of State.
struct StateField {
  std::string name;    ///< of output and checkpoint
  int components = 1;  ///< number of V's: 1, 3, 6 (xx, xy, xz, yy, yz, zz) or 9 (row-major)
  std::string unit;    ///< SI symbol, "1" where dimensionless
  std::string doc;     ///< one sentence
  bool output = true;  ///< offered as an output field
};

/// Of a particle whose state is not admissible, where the general sentence would mislead: "has no
/// voids left", and what helps against it, "lower the loads".
struct InadmissibleText {
  const char* what;
  const char* repair;
};

/// What every law provides:
///
/// - `static constexpr const char* name;` the deck name of the model
/// - `struct Input;` engineering parameters of the deck, SI
/// - `static Schema<Input> schema();` keys, ranges, defaults, checks, citations
/// - `template <class T> struct Params;` numbers the kernels use; trivially copyable
/// - `template <class T> static Params<T> params(const Input&, double density, int dimension);`
/// - `template <class V> struct State;` aggregate of V's only
/// - `static std::vector<StateField> fields();` the entries of State by name
/// - `template <class V, class T> static State<V> initial(const Params<T>&);` undeformed
///
/// and point functions over a scalar or lanes V with scalar T, branch-free in the lanes, free of
/// allocation and of floating-point exceptions for every admissible state (also in branches that a
/// select does not take), callable on host and device:
///
///     Sym3<V> kirchhoff(const Params<T>&, State<V>&, const Mat3<V>& L, T dt);
///         One step with L = dt grad v [1]: F <- (I + L) F, return map; updates the state and
///         returns the Kirchhoff stress tau = J sigma [Pa], tension positive. L = 0 with dt = 0
///         leaves the state alone and returns the stress of the last step: this is how output
///         evaluates stress.
///     V wave_speed(const Params<T>&, const State<V>&);
///         Upper bound of the speed of small waves in the present, deformed state [m/s, spatial].
///     V energy_density(const Params<T>&, const State<V>&);
///         Elastic energy per reference volume [J/m^3].
///     V volume_ratio(const Params<T>&, const State<V>&);
///         Total J, plastic part included: sigma = tau/J, rho = rho0/J.
///     MaskOf<V> admissible(const Params<T>&, const State<V>&);
///         False where the state has left the domain of the law (det F <= 0): the run ends with a
///         fault.
///
/// A law whose stress is a function of its state may give the step in two parts, and kirchhoff as
/// one after the other: a step then stores the state before it works out the stress, which on a
/// GPU leaves more registers.
///
///     void advance(const Params<T>&, State<V>&, const Mat3<V>& L);
///     Sym3<V> stress(const Params<T>&, const State<V>&);
///
/// Optional: `V yield_value(const Params<T>&, const State<V>&)`, the yield function over a scale of
/// stress, at most 0 inside; `V void_ratio(...)`; `V momentum_diffusivity(...)` [m^2/s] of a law
/// with explicit viscosity, which limits the time step; and the constants `effective_stress` (may
/// carry pore water), `hyperelastic = false` (the elastic stress is no derivative of
/// energy_density), `explicit_hardening = true` (the yield surface moves after the return) and
/// `long_chains = true` (eigenproblem, logarithms: most operations wait for the one before, so that
/// a processor does better with two batches at a time).
///
/// Optional functions of the Input, for decks; MaterialEntry says what they mean: `double
/// rest_ratio(const Input&)`; `std::optional<State<double>> state_under(const Input&, const
/// std::array<double, 3>&)` with `std::string stress_repair(const Input&)`; `std::optional<Finding>
/// density_fault(const Input&, double)`; `std::string averaging_doubt(const Input&, bool
/// stressed)`; and the constant `InadmissibleText inadmissible`.
template <class M>
concept Material = requires(const typename M::Input& input) {
  { M::name } -> std::convertible_to<const char*>;
  { M::schema() } -> std::same_as<Schema<typename M::Input>>;
  { M::fields() } -> std::same_as<std::vector<StateField>>;
  {
    M::template params<double>(input, 1.0, 3)
    } -> std::same_as<typename M::template Params<double>>;
  { M::template params<float>(input, 1.0, 2) } -> std::same_as<typename M::template Params<float>>;
  requires std::is_trivially_copyable_v<typename M::template Params<float>>;
  requires std::is_trivially_copyable_v<typename M::template State<double>>;
  requires std::is_aggregate_v<typename M::template State<double>>;
  requires sizeof(typename M::template State<float>) % sizeof(float) == 0;
};

/// Whether a law gives its step in two parts.
template <class M, class V, class T>
inline constexpr bool stress_of_state = requires(const typename M::template Params<T>& params,
                                                 const typename M::template State<V>& s) {
  M::stress(params, s);
};

/// Number of batches whose update a processor interleaves.
template <class M>
inline constexpr int batches_together = requires {
  requires M::long_chains;
}
? 2 : 1;

/// Lame constants of an isotropic solid [Pa].
struct LameConstants {
  double lambda, mu;
};

/// From Young's modulus E [Pa] and Poisson's ratio nu in (-1, 0.5).
inline LameConstants lame_constants(double youngs_modulus, double poissons_ratio) {
  const double nu = poissons_ratio;
  return {youngs_modulus * nu / ((1 + nu) * (1 - 2 * nu)), youngs_modulus / (2 * (1 + nu))};
}

/// Speed [m/s] by which an explicit viscosity shortens the step: with dt <= cfl dx/(c + |v| + 2 d
/// D/dx), dt stays below cfl dx^2/(2 d D), the limit of explicit diffusion times cfl. d: dimension,
/// D: momentum diffusivity [m^2/s]. 0 for laws without one.
template <class M, class V, class T>
SCREE_FN V diffusion_speed(const typename M::template Params<T>& params,
                           const typename M::template State<V>& state, int dimension, T cell_size) {
  if constexpr (requires { M::momentum_diffusivity(params, state); }) {
    return M::momentum_diffusivity(params, state) * (T(2 * dimension) / cell_size);
  } else {
    return broadcast<V>(T(0));
  }
}

namespace detail {

/// (I + L) F
template <class V>
SCREE_FN Mat3<V> advance_gradient(const Mat3<V>& increment, const Mat3<V>& f) {
  return f + increment * f;
}

/// Adds p to the diagonal.
template <class V>
SCREE_FN Sym3<V> plus_diagonal(Sym3<V> a, V p) {
  a.xx = a.xx + p;
  a.yy = a.yy + p;
  a.zz = a.zz + p;
  return a;
}

/// Bounds of the eigenvalues of a symmetric tensor from its invariants: mean +- sqrt(2/3)
/// |deviator|, exact for equal values and for two equal values on the far side. Without an
/// eigenproblem.
template <class V>
struct EigenvalueBounds {
  V lower, upper;
};

template <class V>
SCREE_FN EigenvalueBounds<V> eigenvalue_bounds(const Sym3<V>& a) {
  using T = Scalar<V>;
  const V mean = trace(a) * T(1.0 / 3.0);
  const V radius = norm(deviator(a)) * T(0.81649658092772603);
  return {mean - radius, mean + radius};
}

}  // namespace detail
}  // namespace scree
