// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "solver/base/schema.hpp"
#include "solver/particles/shape.hpp"
#include "solver/particles/shape_spec.hpp"

namespace scree {

namespace {

/// Of polygons and planes.
void flat_keys(Schema<ShapeSpec>& s) {
  s.points("points", &ShapeSpec::points)
      .when("type", {"polygon"})
      .doc("Corners in the x-y plane, in either sense of rotation.");
  s.vector("z", &ShapeSpec::z, Unit::length)
      .length(2)
      .in_dimension(3)
      .when("type", {"polygon"})
      .doc("Heights between which the polygon is extruded.");
  s.vector("point", &ShapeSpec::point, Unit::length)
      .when("type", {"plane"})
      .doc("A point of the plane.");
  s.vector("normal", &ShapeSpec::normal)
      .when("type", {"plane"})
      .doc("Normal out of the solid side, of any length.");
}

Schema<ShapeSpec> make_schema() {
  Schema<ShapeSpec> s("shape", "A solid region of space, combined from simple ones.");
  s.choice("type", &ShapeSpec::kind, shape_kind_names())
      .later({"mesh", "heightmap"})
      .doc("Type of shape; `plane` is a half space, for colliders and as a part of combinations.");
  s.vector("lower", &ShapeSpec::lower, Unit::length).when("type", {"box"}).doc("Lower corner.");
  s.vector("upper", &ShapeSpec::upper, Unit::length).when("type", {"box"}).doc("Upper corner.");
  s.vector("center", &ShapeSpec::center, Unit::length)
      .when("type", {"sphere"})
      .doc("Centre of the sphere (2D: of the disk).");
  s.vector("from", &ShapeSpec::from, Unit::length)
      .when("type", {"cylinder"})
      .doc("Centre of one end; in 2D a cylinder is a strip of width 2 radius, cut off square.");
  s.vector("to", &ShapeSpec::to, Unit::length)
      .when("type", {"cylinder"})
      .doc("Centre of the other end.");
  s.number("radius", &ShapeSpec::radius, Unit::length)
      .above(0)
      .when("type", {"sphere", "cylinder"})
      .doc("Radius.");
  flat_keys(s);
  s.list("of", &ShapeSpec::of, &shape_schema)
      .when("type", {"union", "difference", "intersection"})
      .doc("The parts; a difference is the first less all the others.");
  s.check([](const ShapeSpec& spec, const SchemaContext& context) -> std::optional<Finding> {
    const auto problem = find_problem(spec, context.dimension);
    if (!problem) return std::nullopt;
    return Finding{problem->key, problem->message, "", ""};
  });
  return s;
}

}  // namespace

const Schema<ShapeSpec>& shape_schema() {
  static const Schema<ShapeSpec> schema = make_schema();
  return schema;
}

}  // namespace scree
