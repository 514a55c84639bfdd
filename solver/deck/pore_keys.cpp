// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/pore_keys.hpp"

namespace scree {

const std::vector<std::string>& pore_key_names() {
  static const std::vector<std::string> names{
      "porosity",           "fluid_bulk_modulus",     "fluid_density",
      "grain_bulk_modulus", "biot_coefficient",       "permeability",
      "fluid_viscosity",    "hydraulic_conductivity", "kozeny_carman"};
  return names;
}

/// How easily the water flows.
static void add_flow_keys(Schema<MaterialSpec>& s, const std::vector<std::string>& models) {
  s.number("permeability", &MaterialSpec::permeability, Unit::area)
      .at_least(0)
      .when("model", models)
      .optional()
      .doc("Intrinsic permeability, with fluid_viscosity; or give hydraulic_conductivity.");
  s.number("fluid_viscosity", &MaterialSpec::fluid_viscosity, Unit::viscosity)
      .above(0)
      .when("model", models)
      .optional()
      .doc("Of the water, with permeability.");
  s.number("hydraulic_conductivity", &MaterialSpec::hydraulic_conductivity, Unit::velocity)
      .at_least(0)
      .when("model", models)
      .optional()
      .doc(
          "Darcy's coefficient: permeability = conductivity x viscosity / (fluid_density x 9.81 "
          "m/s^2), whatever method.gravity is.");
  s.flag("kozeny_carman", &MaterialSpec::kozeny_carman)
      .when("model", models)
      .fallback_text("false")
      .doc("The permeability follows the porosity n as n^3/(1 - n)^2.");
  // Without pores the echo of a deck shows nothing of them.
  s.entries().back()->write = [](const void* m, int) {
    return std::string(*static_cast<const bool*>(m) ? "true" : "");
  };
}

void add_pore_keys(Schema<MaterialSpec>& s, const std::vector<std::string>& models) {
  s.number("porosity", &MaterialSpec::porosity)
      .above(0)
      .below(1)
      .when("model", models)
      .fallback_text("no water that flows")
      .doc(
          "Pores per volume at the start, full of water that flows; needs [coupling]. The model's "
          "stress is then the effective one and `density` that of soil and water together. Fields: "
          "`pore_pressure`, `effective_stress`, `porosity`, `seepage_velocity`.");
  s.number("fluid_bulk_modulus", &MaterialSpec::fluid_bulk_modulus, Unit::pressure)
      .above(0)
      .when("model", models)
      .fallback_text("2.2 GPa")
      .doc("Of the water; less with a little air in it.");
  s.number("fluid_density", &MaterialSpec::fluid_density, Unit::density)
      .above(0)
      .when("model", models)
      .fallback_text("1000 kg/m^3")
      .doc("Of the water.");
  s.number("grain_bulk_modulus", &MaterialSpec::grain_bulk_modulus, Unit::pressure)
      .above(0)
      .when("model", models)
      .fallback_text("incompressible grains")
      .doc("Of the grains.");
  s.number("biot_coefficient", &MaterialSpec::biot_coefficient)
      .above(0)
      .at_most(1)
      .when("model", models)
      .fallback_text("1")
      .doc("Share of the pore pressure in the total stress, at least the porosity.");
  add_flow_keys(s, models);
}

std::optional<PoreSetup> MaterialSpec::pores() const {
  if (!porosity) return std::nullopt;
  PoreSetup result;
  result.porosity = *porosity;
  result.fluid_modulus = fluid_bulk_modulus.value_or(2.2e9);
  result.fluid_density = fluid_density.value_or(1000);
  result.grain_compliance = grain_bulk_modulus ? 1 / *grain_bulk_modulus : 0;
  result.biot = biot_coefficient.value_or(1);
  result.mobility = hydraulic_conductivity
                        ? *hydraulic_conductivity / (result.fluid_density * conductivity_gravity)
                        : permeability.value_or(0) / fluid_viscosity.value_or(1);
  result.kozeny_carman = kozeny_carman;
  return result;
}

}  // namespace scree
