// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/schema.hpp"
#include "solver/boundary/collider_spec.hpp"
#include "solver/boundary/face_spec.hpp"
#include "solver/boundary/traction_spec.hpp"

namespace scree {

namespace {

const char* const coefficient_doc = "Coulomb coefficient of friction, tan of the wall's angle.";

Schema<FaceSpec> make_face_schema() {
  Schema<FaceSpec> s("face", "What a face of the domain does to the material; or just its name.");
  s.shorthand_text("type");
  s.choice("type", &FaceSpec::type, face_type_names())
      .later({"absorbing"})
      .doc("Kind of boundary; particles that pass an open face are removed and counted.");
  s.number("coefficient", &FaceSpec::coefficient)
      .at_least(0)
      .when("type", {"friction"})
      .doc(coefficient_doc);
  return s;
}

const char* const face_names[3][2] = {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}};

/// The periodic face of `axis` whose opposite face is not periodic.
std::optional<Finding> lone_periodic_face(const BoundarySpec& spec, int axis) {
  for (int side = 0; side < 2; ++side) {
    const bool here = spec.face(axis, side).type == FaceType::periodic;
    const bool there = spec.face(axis, 1 - side).type == FaceType::periodic;
    if (here && !there) {
      return Finding{face_names[axis][side], "a periodic face needs its opposite face periodic too",
                     "", std::string("set ") + face_names[axis][1 - side] + " = \"periodic\""};
    }
  }
  return std::nullopt;
}

/// no_slip = "face" where no face can hold the material.
std::optional<Finding> idle_no_slip(const BoundarySpec& spec, const SchemaContext& context) {
  if (spec.no_slip == NoSlip::node) return std::nullopt;
  for (int axis = 0; axis < context.dimension; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const FaceType type = spec.face(axis, side).type;
      if (type == FaceType::sticky || type == FaceType::friction) return std::nullopt;
    }
  }
  return Finding{"no_slip", "no_slip concerns sticky and friction faces, and there is none", "",
                 "delete no_slip, or make a face \"sticky\" or one with friction"};
}

Schema<BoundarySpec> make_boundary_schema() {
  Schema<BoundarySpec> s("boundary", "The faces of the domain.");
  s.table("x_min", &BoundarySpec::x_min, &face_schema).fallback_text("open").doc("Left face.");
  s.table("x_max", &BoundarySpec::x_max, &face_schema).fallback_text("open").doc("Right face.");
  s.table("y_min", &BoundarySpec::y_min, &face_schema).fallback_text("open").doc("Lower y face.");
  s.table("y_max", &BoundarySpec::y_max, &face_schema).fallback_text("open").doc("Upper y face.");
  s.table("z_min", &BoundarySpec::z_min, &face_schema)
      .in_dimension(3)
      .fallback_text("open")
      .doc("Lower z face.");
  s.table("z_max", &BoundarySpec::z_max, &face_schema)
      .in_dimension(3)
      .fallback_text("open")
      .doc("Upper z face.");
  s.choice("no_slip", &BoundarySpec::no_slip, no_slip_names())
      .fallback(NoSlip::node)
      .doc(
          "Where sticky faces, and friction faces that hold, stop the material along them: at the "
          "nodes beside the face, which then bears a part of a shear stress (first order), or at "
          "the face itself, which bears the whole (second order; for fluids, slopes, shear flows). "
          "Colliders always hold at nodes.");
  s.check({"no_slip"}, idle_no_slip);
  for (int axis = 0; axis < 3; ++axis) {
    s.check({face_names[axis][0], face_names[axis][1]},
            [axis](const BoundarySpec& spec, const SchemaContext& context) {
              return axis < context.dimension ? lone_periodic_face(spec, axis) : std::nullopt;
            });
  }
  return s;
}

Schema<ContactSpec> make_contact_schema() {
  Schema<ContactSpec> s("contact", "How a collider acts on the material; or just its name.");
  s.shorthand_text("type");
  s.choice("type", &ContactSpec::type, contact_type_names()).doc("Kind of contact.");
  s.number("coefficient", &ContactSpec::coefficient)
      .at_least(0)
      .when("type", {"friction"})
      .doc(coefficient_doc);
  return s;
}

Schema<ColliderSpec> make_collider_schema() {
  Schema<ColliderSpec> s("collider", "A rigid body, fixed or moved with a prescribed velocity.");
  s.table("shape", &ColliderSpec::shape, &shape_schema)
      .doc(
          "The solid, as it lies at t = 0; it may reach out of the domain. Between periodic faces "
          "it "
          "is repeated as the domain is.");
  s.formulas("velocity", &ColliderSpec::velocity, Unit::velocity, {"t"})
      .fallback_text("at rest")
      .doc("Velocity of translation.");
  s.table("contact", &ColliderSpec::contact, &contact_schema).doc("Contact with the material.");
  return s;
}

bool given(const std::array<Formula, 3>& value) {
  return std::any_of(value.begin(), value.end(), [](const Formula& f) { return f.given(); });
}

Schema<TractionSpec> make_traction_schema() {
  const std::vector<std::string> variables{"x", "y", "z", "X", "Y", "Z", "t"};
  Schema<TractionSpec> s("traction", "A load on the exposed faces of a body's particles.");
  s.text("body", &TractionSpec::body).doc("Name of the loaded body.");
  s.table("region", &TractionSpec::region, &shape_schema)
      .doc("Loads the particle faces whose centres lie here at t = 0, rim included.");
  s.vector("facing", &TractionSpec::facing)
      .fallback({0, 0, 0})
      .doc("Loads only faces whose outward normal is within 60 degrees of this; zero: all.");
  s.formula("pressure", &TractionSpec::pressure, Unit::pressure, variables)
      .optional()
      .doc("Pressure on the present surface, compression positive.");
  s.formulas("value", &TractionSpec::value, Unit::pressure, variables)
      .optional()
      .doc("Force per reference area, in fixed directions.");
  s.check([](const TractionSpec& spec, const SchemaContext&) -> std::optional<Finding> {
    if (spec.pressure.given() != given(spec.value)) return std::nullopt;
    return Finding{"pressure", "a traction is given by exactly one of `pressure` and `value`", "",
                   spec.pressure.given() ? "delete one of them" : "add one of them"};
  });
  return s;
}

}  // namespace

const Schema<FaceSpec>& face_schema() {
  static const Schema<FaceSpec> schema = make_face_schema();
  return schema;
}

const Schema<BoundarySpec>& boundary_schema() {
  static const Schema<BoundarySpec> schema = make_boundary_schema();
  return schema;
}

const Schema<ContactSpec>& contact_schema() {
  static const Schema<ContactSpec> schema = make_contact_schema();
  return schema;
}

const Schema<ColliderSpec>& collider_schema() {
  static const Schema<ColliderSpec> schema = make_collider_schema();
  return schema;
}

const Schema<TractionSpec>& traction_schema() {
  static const Schema<TractionSpec> schema = make_traction_schema();
  return schema;
}

}  // namespace scree
