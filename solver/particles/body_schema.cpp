// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/body_spec.hpp"

namespace scree {
namespace {

Schema<InitialStressSpec> make_initial_stress_schema() {
  Schema<InitialStressSpec> s("initial_stress",
                              "The stress of a body at the start, in place of what its material's "
                              "keys say of it (initial_pressure, initial_j). Effective where there "
                              "is pore water, for excess pore pressures start from zero; a uniform "
                              "one may be given as total stress.");
  s.choice("type", &InitialStressSpec::type,
           {{"geostatic", InitialStressType::geostatic}, {"uniform", InitialStressType::uniform}})
      .doc(
          "geostatic: own weight (density and gravity at t = 0, which must be along an axis) below "
          "a level surface; uniform: the same everywhere.");
  s.number("surface", &InitialStressSpec::surface, Unit::length)
      .when("type", {"geostatic"})
      .doc("Coordinate of the free surface along the axis of gravity; no particle above it.");
  s.number("k0", &InitialStressSpec::k0)
      .at_least(0)
      .when("type", {"geostatic"})
      .fallback_text(
          "the model's (user guide, section 9): 1 - sin(friction_angle), the ratio of "
          "one-dimensional compression, poissons_ratio/(1 - poissons_ratio) or, in fluids, 1")
      .doc("Horizontal over vertical stress.");
  s.vector("value", &InitialStressSpec::value, Unit::pressure)
      .length(3)
      .when("type", {"uniform"})
      .doc("Normal stresses xx, yy, zz, tension positive; zz also in 2D.");
  s.flag("total", &InitialStressSpec::total)
      .when("type", {"uniform"})
      .fallback(false)
      .doc(
          "value is the total stress: every particle starts from the effective one, value + "
          "biot_coefficient x its pore pressure at the start (coupling.initial_pressure, "
          "water_table). Only where water flows.");
  return s;
}

Schema<BodySpec> make_body_schema() {
  Schema<BodySpec> s("body", "A shape filled with particles of one material.");
  s.text("material", &BodySpec::material).doc("Name of a [material.NAME] table.");
  s.table("shape", &BodySpec::shape, &shape_schema).doc("The region to fill, inside the domain.");
  s.integer("particles_per_direction", &BodySpec::particles_per_direction)
      .at_least(1)
      .at_most(16)
      .fallback_by([](const SchemaContext& context) { return context.kernel == "compact" ? 3 : 2; },
                   "3 with the compact kernel, else 2")
      .doc("Particles a cell along each axis.");
  s.formulas("velocity", &BodySpec::velocity, Unit::velocity, {"x", "y", "z"})
      .fallback({Formula{"0.0"}, Formula{"0.0"}, Formula{"0.0"}})
      .doc(
          "Initial velocity; entries may be expressions of x, y, z. Its gradient sets the initial "
          "affine matrix.");
  s.table("initial_stress", &BodySpec::initial_stress, &initial_stress_schema)
      .fallback_text("none")
      .doc("Stress at the start.");
  return s;
}

}  // namespace

const Schema<InitialStressSpec>& initial_stress_schema() {
  static const Schema<InitialStressSpec> schema = make_initial_stress_schema();
  return schema;
}

const Schema<BodySpec>& body_schema() {
  static const Schema<BodySpec> schema = make_body_schema();
  return schema;
}

}  // namespace scree
