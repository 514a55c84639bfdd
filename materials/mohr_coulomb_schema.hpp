// SPDX-License-Identifier: Apache-2.0
/// \file
/// Deck keys of MohrCoulomb; included by mohr_coulomb_params.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "materials/mohr_coulomb.hpp"
#include "materials/mohr_coulomb_params.hpp"

namespace scree {

namespace detail {

inline void mohr_coulomb_peak_keys(Schema<MohrCoulomb::Input>& s) {
  using Input = MohrCoulomb::Input;
  constexpr double right_angle = 1.57079632679489662;
  s.number("friction_angle", &Input::friction_angle, Unit::angle)
      .typical(0.55)
      .at_least(0)
      .below(right_angle)
      .doc("Friction angle; 0 with a cohesion: Tresca's law.");
  s.number("cohesion", &Input::cohesion, Unit::pressure).at_least(0).fallback(0.0).doc("Cohesion.");
  s.number("dilation_angle", &Input::dilation_angle, Unit::angle)
      .at_least(0)
      .below(right_angle)
      .fallback(0.0)
      .doc("Dilation angle, at most friction_angle; 0: plastic shear at constant volume.");
  s.number("tension_cutoff", &Input::tension_cutoff, Unit::pressure)
      .at_least(0)
      .fallback_text("none: the apex of the pyramid, cohesion cot(friction_angle)")
      .doc("Largest tensile principal stress.");
}

inline void mohr_coulomb_residual_keys(Schema<MohrCoulomb::Input>& s) {
  using Input = MohrCoulomb::Input;
  constexpr double right_angle = 1.57079632679489662;
  s.number("residual_friction_angle", &Input::residual_friction_angle, Unit::angle)
      .at_least(0)
      .below(right_angle)
      .fallback_text("friction_angle")
      .doc("Friction angle after softening.");
  s.number("residual_cohesion", &Input::residual_cohesion, Unit::pressure)
      .at_least(0)
      .fallback_text("cohesion")
      .doc("Cohesion after softening.");
  s.number("residual_dilation_angle", &Input::residual_dilation_angle, Unit::angle)
      .at_least(0)
      .below(right_angle)
      .fallback_text("dilation_angle")
      .doc("Dilation angle after softening.");
  s.number("softening_strain", &Input::softening_strain)
      .above(0)
      .fallback_text("not set: no softening")
      .doc(
          "Equivalent plastic strain over which angles and cohesion fall linearly to the residual "
          "values.");
}

inline std::optional<Finding> mohr_coulomb_strength_finding(const MohrCoulomb::Input& in) {
  const MohrCoulombRange range(in);
  if (range.friction[0] == 0 && range.cohesion[0] == 0)
    return Finding{"friction_angle", "a soil without friction and cohesion has no strength",
                   "above 0, or a cohesion above 0", "give a cohesion, or use a fluid"};
  if (range.dilation[0] > range.friction[0])
    return Finding{"dilation_angle", "dilation above friction would create energy",
                   "0 to friction_angle", "lower dilation_angle or raise friction_angle"};
  const double slope = std::tan(range.friction[0]);
  if (!std::isnan(in.tension_cutoff) && in.tension_cutoff * slope > range.cohesion[0]) {
    return Finding{
        "tension_cutoff", "lies beyond the apex of the pyramid and would do nothing",
        "0 to cohesion cot(friction_angle) = " + std::to_string(range.cohesion[0] / slope) + " Pa",
        "lower it, or remove it"};
  }
  return std::nullopt;
}

inline std::optional<Finding> mohr_coulomb_residual_finding(const MohrCoulomb::Input& in) {
  const MohrCoulombRange range(in);
  if (range.friction[1] > range.friction[0])
    return Finding{"residual_friction_angle", "is above the peak: softening cannot harden",
                   "0 to friction_angle", "lower it, or raise friction_angle"};
  if (range.cohesion[1] > range.cohesion[0])
    return Finding{"residual_cohesion", "is above the peak: softening cannot harden",
                   "0 to cohesion", "lower it, or raise cohesion"};
  if (range.dilation[1] > range.friction[1])
    return Finding{"residual_dilation_angle",
                   "residual dilation above residual friction would create energy",
                   "0 to residual_friction_angle", "give a residual_dilation_angle, e.g. 0"};
  if (range.friction[1] == 0 && range.cohesion[1] == 0)
    return Finding{"residual_friction_angle", "nothing would be left of the strength",
                   "above 0, or a residual_cohesion above 0",
                   "give a small residual cohesion or friction angle"};
  return std::nullopt;
}

inline std::optional<Finding> softening_finding(const MohrCoulomb::Input& in) {
  const bool residual = !std::isnan(in.residual_friction_angle) ||
                        !std::isnan(in.residual_cohesion) ||
                        !std::isnan(in.residual_dilation_angle);
  if (std::isnan(in.softening_strain)) {
    if (!residual) return std::nullopt;
    return Finding{"softening_strain", "is missing beside residual values", "above 0",
                   "add softening_strain = ..., or remove the residual values"};
  }
  if (!residual)
    return Finding{"softening_strain", "has no residual values to lead to",
                   "with residual_friction_angle, residual_cohesion or residual_dilation_angle",
                   "give one of them, or remove softening_strain"};
  const double rate = SofteningRates(in).cohesion;
  if (rate <= largest_softening) return std::nullopt;
  return Finding{"softening_strain",
                 "lets the cohesion fall faster than the soil can unload elastically",
                 "above " + std::to_string(in.softening_strain * rate / largest_softening),
                 "raise softening_strain or the residual values"};
}

}  // namespace detail

inline Schema<MohrCoulomb::Input> MohrCoulomb::schema() {
  Schema<Input> s(name, "Soil: Hencky elasticity with the Mohr-Coulomb pyramid.");
  elastic_keys(s);
  detail::mohr_coulomb_peak_keys(s);
  detail::mohr_coulomb_residual_keys(s);
  s.check({"friction_angle", "cohesion", "dilation_angle"}, [](const Input& in,
                                                               const SchemaContext&) {
    return std::isnan(in.friction_angle) ? std::nullopt : detail::mohr_coulomb_strength_finding(in);
  });
  s.check([](const Input& in, const SchemaContext&) { return detail::softening_finding(in); });
  s.check([](const Input& in, const SchemaContext&) -> std::optional<Finding> {
    if (std::isnan(in.softening_strain)) return std::nullopt;
    return detail::mohr_coulomb_residual_finding(in);
  });
  s.cite(
      "de Souza Neto, Peric, Owen, Computational Methods for Plasticity: Theory and Applications, "
      "Wiley 2008, doi 10.1002/9780470694626");
  return s;
}

}  // namespace scree
