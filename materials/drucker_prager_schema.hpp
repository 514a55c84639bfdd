// SPDX-License-Identifier: Apache-2.0
/// \file
/// Deck keys of DruckerPrager; included by drucker_prager.hpp.
#pragma once

#include "materials/drucker_prager.hpp"
#include "materials/elastic_keys.hpp"

namespace scree {

namespace detail {

/// No small friction but another law.
inline Finding no_friction() {
  return {"friction_angle", "a cone without friction has no tip", "above 0 deg and below 90 deg",
          "use model = \"von_mises\", whose yield_stress is sqrt(3) times the cohesion in plane "
          "strain, twice the cohesion in triaxial states"};
}

/// Friction angle of friction_angle or of h0 to h3, and what is wrong with them.
inline std::optional<Finding> friction_finding(const DruckerPrager::Input& in) {
  const FrictionHardening h = in.hardening();
  if (h.none_given()) {
    if (std::isnan(in.friction_angle))
      return Finding{"friction_angle", "required key is missing",
                     "an angle [rad], or friction hardening by h0, h1, h2 and h3",
                     "add friction_angle = ..."};
    return in.friction_angle > 0 ? std::nullopt : std::optional(no_friction());
  }
  if (!h.all_given())
    return Finding{std::isnan(h.h0)   ? "h0"
                   : std::isnan(h.h1) ? "h1"
                   : std::isnan(h.h2) ? "h2"
                                      : "h3",
                   "friction hardening is incomplete", "all of h0, h1, h2, h3, or none",
                   "add the missing ones, or remove all four and give friction_angle"};
  if (!std::isnan(in.friction_angle))
    return Finding{"friction_angle",
                   "has no meaning beside h0 to h3, which give the friction angle",
                   "friction_angle, or h0, h1, h2 and h3", "remove one of the two"};
  if (h.angle(0) <= 0)
    return Finding{"h3", "makes the first friction angle h0 - h3 vanish", "below h0",
                   "lower h3 or raise h0"};
  if (h.highest_angle() >= 1.57079632679489662)
    return Finding{"h1", "lets the friction angle grow to 90 degrees",
                   "h0 + h1/h2 exp(-1 - h2 h3/h1) below 90 deg", "lower h1 or raise h2"};
  return std::nullopt;
}

/// Lets the last key of the schema refuse zero, which is outside its range, in words of its own.
inline void explain_zero_friction(Schema<DruckerPrager::Input>& s) {
  Entry& entry = *s.entries().back();
  Entry closed = entry;
  closed.lower_open = false;
  entry.read = [closed, read = entry.read](void* member, const Value& value,
                                           const std::string& path, SchemaReader& reader) {
    Problems elsewhere;
    double angle = 1;
    const bool number =
        SchemaReader(reader.context(), elsewhere).number(closed, value, path, angle);
    if (!number || angle != 0) return read(member, value, path, reader);
    const Finding finding = no_friction();
    reader.report(value, path, finding.message, finding.allowed, finding.repair);
  };
}

inline void strength_keys(Schema<DruckerPrager::Input>& s) {
  using Input = DruckerPrager::Input;
  constexpr double right_angle = 1.57079632679489662;
  s.number("friction_angle", &Input::friction_angle, Unit::angle)
      .typical(0.55)
      .above(0)
      .below(right_angle)
      .fallback_text("required without h0 to h3")
      .doc(
          "Friction angle of the Mohr-Coulomb law that the cone stands for; without friction use "
          "von_mises.");
  explain_zero_friction(s);
  s.number("cohesion", &Input::cohesion, Unit::pressure)
      .at_least(0)
      .fallback(0.0)
      .doc("Cohesion of that Mohr-Coulomb law.");
  s.number("dilation_angle", &Input::dilation_angle, Unit::angle)
      .at_least(0)
      .below(right_angle)
      .fallback(0.0)
      .doc("Dilation angle, at most friction_angle; 0: plastic shear at constant volume.");
}

inline std::optional<Finding> dilation_finding(const DruckerPrager::Input& in) {
  const FrictionHardening h = in.hardening();
  // 1e-12: h0 - h3 is rounded.
  const double friction = h.all_given() ? h.angle(0) * (1 + 1e-12) : in.friction_angle;
  // Without any friction angle, or with h3 above h0, the other check speaks.
  if (std::isnan(friction) || friction < 0 || in.dilation_angle <= friction) return std::nullopt;
  return Finding{"dilation_angle", "dilation above friction would create energy",
                 h.all_given() ? "0 to h0 - h3" : "0 to friction_angle",
                 h.all_given() ? "lower dilation_angle or h3"
                               : "lower dilation_angle or raise friction_angle"};
}

inline void hardening_keys(Schema<DruckerPrager::Input>& s) {
  using Input = DruckerPrager::Input;
  constexpr double right_angle = 1.57079632679489662;
  s.number("h0", &Input::h0, Unit::angle)
      .above(0)
      .below(right_angle)
      .optional()
      .doc(
          "Friction hardening phi = h0 + (h1 q - h3) exp(-h2 q) over the plastic shear strain q, "
          "instead of friction_angle: the angle at large strain. All of h0 to h3, or none.");
  s.number("h1", &Input::h1, Unit::angle)
      .at_least(0)
      .optional()
      .doc("Friction hardening: growth per plastic shear strain.");
  s.number("h2", &Input::h2)
      .above(0)
      .optional()
      .doc("Friction hardening: decay, per plastic shear strain.");
  s.number("h3", &Input::h3, Unit::angle)
      .at_least(0)
      .below(right_angle)
      .optional()
      .doc("Friction hardening: the first friction angle is h0 - h3.");
}

}  // namespace detail

inline Schema<DruckerPrager::Input> DruckerPrager::schema() {
  Schema<Input> s(name, "Sand: Hencky elasticity with a Drucker-Prager cone.");
  elastic_keys(s);
  detail::strength_keys(s);
  s.choice("match", &Input::match,
           {{"compression", Match::compression},
            {"extension", Match::extension},
            {"plane_strain", Match::plane_strain}})
      .fallback_by(
          [](const SchemaContext& c) { return resolve_match(Match::by_dimension, c.dimension); },
          "plane_strain in 2D, compression in 3D")
      .doc("State of stress in which cone and Mohr-Coulomb agree.");
  detail::hardening_keys(s);
  s.check({"friction_angle", "h0", "h1", "h2", "h3"},
          [](const Input& in, const SchemaContext&) { return detail::friction_finding(in); });
  s.check({"friction_angle", "dilation_angle", "h0", "h3"},
          [](const Input& in, const SchemaContext&) { return detail::dilation_finding(in); });
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
