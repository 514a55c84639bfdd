// SPDX-License-Identifier: Apache-2.0
/// \file
/// Deck keys of ModifiedCamClay; included by modified_cam_clay.hpp.
#pragma once

#include "materials/modified_cam_clay.hpp"

namespace scree {

namespace detail {

inline void cam_clay_line_keys(Schema<ModifiedCamClay::Input>& s) {
  using Input = ModifiedCamClay::Input;
  s.number("m", &Input::m).typical(1.2).above(0).doc("Slope M = q/p of the critical state line.");
  s.number("lambda", &Input::lambda)
      .typical(0.2)
      .above(0)
      .doc("Slope of the normal compression line in v over ln p; above kappa.");
  s.number("kappa", &Input::kappa)
      .typical(0.04)
      .above(0)
      .doc("Slope of swelling lines in v over ln p.");
  s.number("poissons_ratio", &Input::poissons_ratio)
      .typical(0.3)
      .above(-1)
      .below(0.5)
      .doc("Poisson's ratio of elastic changes of stress.");
  s.number("reference_void_ratio", &Input::reference_void_ratio)
      .typical(2)
      .above(0)
      .doc("Void ratio of the normal compression line at p = 1 kPa, N - 1.");
}

inline void cam_clay_start_keys(Schema<ModifiedCamClay::Input>& s) {
  using Input = ModifiedCamClay::Input;
  s.number("initial_pressure", &Input::initial_pressure, Unit::pressure)
      .typical(1e5)
      .above(0)
      .doc(
          "Mean effective pressure at the start, at most preconsolidation_pressure; the body "
          "begins under this isotropic stress. "
          "Under initial_stress it has no effect.");
  s.number("preconsolidation_pressure", &Input::preconsolidation_pressure, Unit::pressure)
      .above(0)
      .doc(
          "Isotropic pressure pc at which the soil yields at the start, the same everywhere; or "
          "give "
          "ocr.");
  s.number("ocr", &Input::ocr)
      .typical(1.5)
      .at_least(1)
      .doc(
          "Overconsolidation ratio at the start, instead of preconsolidation_pressure: pc/p, under "
          "initial_stress at each place pc/(p + q^2/(M^2 p)).");
}

inline void cam_clay_checks(Schema<ModifiedCamClay::Input>& s) {
  using Input = ModifiedCamClay::Input;
  using Result = std::optional<Finding>;
  s.check({"lambda", "kappa"}, [](const Input& in, const SchemaContext&) -> Result {
    if (in.lambda > in.kappa) return std::nullopt;
    return Finding{"lambda", "soil that swells more than it compresses cannot harden",
                   "above kappa", "raise lambda or lower kappa"};
  });
  s.check(
      {"preconsolidation_pressure", "ocr"}, [](const Input& in, const SchemaContext&) -> Result {
        if (in.preconsolidation_pressure.has_value() != in.ocr.has_value()) return std::nullopt;
        return Finding{"preconsolidation_pressure",
                       in.ocr ? "preconsolidation is given twice" : "preconsolidation is not known",
                       "one of preconsolidation_pressure and ocr",
                       in.ocr ? "remove one of them" : "add one of them"};
      });
  s.check({"preconsolidation_pressure", "initial_pressure"},
          [](const Input& in, const SchemaContext&) -> Result {
            if (in.ocr || !in.preconsolidation_pressure ||
                in.initial_pressure <= *in.preconsolidation_pressure)
              return std::nullopt;
            return Finding{"initial_pressure", "the initial stress lies outside the yield surface",
                           "at most preconsolidation_pressure",
                           "lower initial_pressure or raise preconsolidation_pressure"};
          });
}

inline Finding cam_clay_without_voids(const ModifiedCamClay::Input& in, double specific_volume) {
  return {"reference_void_ratio",
          "the initial void ratio, " + std::to_string(specific_volume - 1) + ", is not positive",
          "above " + std::to_string(in.reference_void_ratio + 1 - specific_volume),
          "raise reference_void_ratio, or lower lambda or the pressures"};
}

}  // namespace detail

inline Schema<ModifiedCamClay::Input> ModifiedCamClay::schema() {
  Schema<Input> s(name, "Clay: modified Cam clay, critical state soil mechanics.");
  detail::cam_clay_line_keys(s);
  detail::cam_clay_start_keys(s);
  detail::cam_clay_checks(s);
  s.check([](const Input& in, const SchemaContext&) -> std::optional<Finding> {
    const bool known = in.preconsolidation_pressure.has_value() != in.ocr.has_value();
    if (in.lambda <= in.kappa || !known || specific_volume(in) > 1) return std::nullopt;
    return detail::cam_clay_without_voids(in, specific_volume(in));
  });
  s.cite(
      "Roscoe, Burland, On the generalised stress-strain behaviour of 'wet' clay, in: Engineering "
      "Plasticity, Cambridge University Press 1968");
  s.cite(
      "Wood, Soil Behaviour and Critical State Soil Mechanics, Cambridge University Press 1990, "
      "doi 10.1017/CBO9781139878272");
  return s;
}

}  // namespace scree
