// SPDX-License-Identifier: Apache-2.0
/// \file
/// Law and Family of a C++ type; included where a law is compiled for the tests.
#pragma once

#include <cstring>

#include "verification/conformance/law.hpp"

namespace scree::testing {

template <class M, class T>
class PointOf final : public Point<T> {
 public:
  using State = typename M::template State<T>;
  static_assert(sizeof(State) <= sizeof(Entries<T>));

  explicit PointOf(const typename M::Input& input) : p_(M::template params<T>(input, density, 3)) {}

  Entries<T> initial() const override { return pack(M::template initial<T>(p_)); }
  Sym3<T> kirchhoff(Entries<T>& entries, const Mat3<T>& L, T dt) const override {
    State state = unpack(entries);
    const Sym3<T> tau = M::kirchhoff(p_, state, L, dt);
    entries = pack(state);
    return tau;
  }
  T wave_speed(const Entries<T>& e) const override { return M::wave_speed(p_, unpack(e)); }
  T energy_density(const Entries<T>& e) const override { return M::energy_density(p_, unpack(e)); }
  T volume_ratio(const Entries<T>& e) const override { return M::volume_ratio(p_, unpack(e)); }
  bool admissible(const Entries<T>& e) const override { return M::admissible(p_, unpack(e)); }
  std::optional<T> yield_value(const Entries<T>& e) const override {
    if constexpr (requires(const State& s) { M::yield_value(p_, s); }) {
      return M::yield_value(p_, unpack(e));
    } else {
      return std::nullopt;
    }
  }

 private:
  static Entries<T> pack(const State& state) {
    Entries<T> entries{};
    std::memcpy(entries.data(), &state, sizeof state);
    return entries;
  }
  static State unpack(const Entries<T>& entries) {
    State state;
    std::memcpy(static_cast<void*>(&state), entries.data(), sizeof state);
    return state;
  }
  typename M::template Params<T> p_;
};

/// A law in double precision; enough for laws of the tests.
template <class M>
Law make_exact_law(const typename M::Input& input) {
  Law law;
  law.name = M::name;
  law.fields = M::fields();
  if constexpr (requires { M::hyperelastic; }) law.stress_from_energy = M::hyperelastic;
  if constexpr (requires { M::explicit_hardening; }) law.explicit_hardening = M::explicit_hardening;
  law.exact = std::make_unique<PointOf<M, double>>(input);
  const double c = law.exact->wave_speed(law.exact->initial());
  law.stiffness = density * c * c;
  return law;
}

template <class M>
Law make_law(const std::any& input) {
  const auto& in = std::any_cast<const typename M::Input&>(input);
  Law law = make_exact_law<M>(in);
  law.single = std::make_unique<PointOf<M, float>>(in);
  return law;
}

template <class M>
Family make_family(const std::vector<typename M::Input>& inputs) {
  static_assert(Material<M>);
  static const auto schema = M::schema();
  Family family;
  family.name = M::name;
  family.schema = &schema;
  family.inputs.assign(inputs.begin(), inputs.end());
  family.input_pointer = [](std::any& input) -> void* {
    return &std::any_cast<typename M::Input&>(input);
  };
  family.make = &make_law<M>;
  return family;
}

}  // namespace scree::testing
