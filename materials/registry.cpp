// SPDX-License-Identifier: Apache-2.0
#include "materials/registry.hpp"

#include <cmath>
#include <cstring>

#include "generated/materials.hpp"

namespace scree {

namespace {

/// K0 where nothing else is known: the law's own `rest_ratio`, or Jaky's 1 - sin phi for friction
/// (Jaky, The coefficient of earth pressure at rest, J. Soc. Hung. Eng. Arch. 78, 1944), where a
/// slope M of q over p means sin phi = 3 M/(6 + M) of triaxial compression, or the ratio of
/// confined elasticity, or that of a fluid.
template <Material M>
double rest_ratio(const typename M::Input& in) {
  if constexpr (requires { M::rest_ratio(in); }) {
    return M::rest_ratio(in);
  } else if constexpr (requires { in.friction_angle; }) {
    double angle = in.friction_angle;
    if constexpr (requires { in.hardening(); }) {
      if (in.hardening().given()) angle = in.hardening().angle(0);
    }
    return 1 - std::sin(angle);
  } else if constexpr (requires { in.m; }) {
    return 1 - 3 * in.m / (6 + in.m);
  } else if constexpr (requires { in.poissons_ratio; }) {
    return in.poissons_ratio / (1 - in.poissons_ratio);
  } else {
    return 1;
  }
}

template <Material M>
std::optional<std::vector<double>> state_under(const std::any& input,
                                               const std::array<double, 3>& stress) {
  const auto state = M::state_under(std::any_cast<const typename M::Input&>(input), stress);
  if (!state) return std::nullopt;
  std::vector<double> entries(sizeof *state / sizeof(double));
  std::memcpy(entries.data(), &*state, sizeof *state);
  return entries;
}

/// The functions that only some laws have.
template <Material M>
void add_optional(MaterialEntry& entry) {
  using Input = typename M::Input;
  if constexpr (requires { M::effective_stress; }) entry.effective_stress = M::effective_stress;
  if constexpr (requires { M::fluid; }) entry.fluid = M::fluid;
  if constexpr (requires { M::inadmissible; }) entry.inadmissible = M::inadmissible;
  if constexpr (requires(const Input& in) { M::stress_repair(in); }) {
    entry.state_under = state_under<M>;
    entry.stress_repair = [](const std::any& input) {
      return M::stress_repair(std::any_cast<const Input&>(input));
    };
  }
  if constexpr (requires(const Input& in) { M::density_fault(in, 1.0); }) {
    entry.density_fault = [](const std::any& input, double density) {
      return M::density_fault(std::any_cast<const Input&>(input), density);
    };
  }
  if constexpr (requires(const Input& in) { M::averaging_doubt(in, true); }) {
    entry.averaging_doubt = [](const std::any& input, bool stressed) {
      return M::averaging_doubt(std::any_cast<const Input&>(input), stressed);
    };
  }
}

template <Material M>
MaterialEntry make_entry() {
  static const auto schema = M::schema();
  MaterialEntry entry;
  entry.name = M::name;
  entry.schema = &schema;
  entry.fields = M::fields();
  entry.make_input = [] { return std::any(typename M::Input{}); };
  entry.input_pointer = [](std::any& input) -> void* {
    return &std::any_cast<typename M::Input&>(input);
  };
  entry.rest_ratio = [](const std::any& input) {
    return rest_ratio<M>(std::any_cast<const typename M::Input&>(input));
  };
  add_optional<M>(entry);
  return entry;
}

}  // namespace

const std::vector<MaterialEntry>& material_registry() {
  static const std::vector<MaterialEntry> registry = [] {
    std::vector<MaterialEntry> entries;
#define SCREE_MATERIAL(header, Type) entries.push_back(make_entry<Type>());
#include "generated/materials.def"
#undef SCREE_MATERIAL
    return entries;
  }();
  return registry;
}

const MaterialEntry* find_material_model(std::string_view name) {
  for (const MaterialEntry& entry : material_registry()) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

}  // namespace scree
