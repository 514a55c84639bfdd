// SPDX-License-Identifier: Apache-2.0
/// \file
/// Deck keys of DruckerPrager; included by drucker_prager.hpp.
#pragma once

#include "materials/drucker_prager.hpp"

namespace scree {

inline Schema<DruckerPrager::Input> DruckerPrager::schema() {
  constexpr double right_angle = 1.57079632679489662;
  Schema<Input> s(name, "Sand: Hencky elasticity with a Drucker-Prager cone.");
  s.number("youngs_modulus", &Input::youngs_modulus, Unit::pressure)
      .above(0)
      .doc("Young's modulus at small strain.");
  s.number("poissons_ratio", &Input::poissons_ratio)
      .above(-1)
      .below(0.5)
      .doc("Poisson's ratio at small strain.");
  s.number("friction_angle", &Input::friction_angle, Unit::angle)
      .at_least(0)
      .below(right_angle)
      .doc("Friction angle of the Mohr-Coulomb law that the cone stands for.");
  s.number("cohesion", &Input::cohesion, Unit::pressure)
      .at_least(0)
      .fallback(0.0)
      .doc("Cohesion of that Mohr-Coulomb law.");
  s.number("dilation_angle", &Input::dilation_angle, Unit::angle)
      .at_least(0)
      .below(right_angle)
      .fallback(0.0)
      .doc("Dilation angle; 0: plastic shear at constant volume.");
  s.choice("match", &Input::match,
           {{"compression", Match::compression},
            {"extension", Match::extension},
            {"plane_strain", Match::plane_strain}})
      .fallback_by(
          [](const SchemaContext& c) { return resolve_match(Match::by_dimension, c.dimension); },
          "plane_strain in 2D, compression in 3D")
      .doc("State of stress in which cone and Mohr-Coulomb agree.");
  s.check({"friction_angle"}, [](const Input& in, const SchemaContext&) -> std::optional<Finding> {
    if (in.friction_angle > 0) return std::nullopt;
    return Finding{"friction_angle", "a cone without friction has no tip", "above 0",
                   "use model = \"von_mises\", whose yield_stress is sqrt(3) times the cohesion in "
                   "plane strain, twice the cohesion in triaxial states"};
  });
  s.check({"friction_angle", "dilation_angle"},
          [](const Input& in, const SchemaContext&) -> std::optional<Finding> {
            if (in.dilation_angle <= in.friction_angle) return std::nullopt;
            return Finding{"dilation_angle", "dilation above friction would create energy",
                           "0 to friction_angle", "lower dilation_angle or raise friction_angle"};
          });
  s.cite(
      "Klar, Gast, Pradhana, Fu, Schroeder, Jiang, Teran, Drucker-Prager elastoplasticity for sand "
      "animation, ACM TOG 35(4), 2016, doi 10.1145/2897824.2925906");
  s.cite(
      "Tampubolon, Gast, Klar, Fu, Teran, Jiang, Museth, Multi-species simulation of porous sand "
      "and "
      "water mixtures, ACM TOG 36(4), 2017, doi 10.1145/3072959.3073651");
  return s;
}

}  // namespace scree
