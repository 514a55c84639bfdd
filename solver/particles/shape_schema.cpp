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

Schema<RotationSpec> make_rotation_schema() {
  Schema<RotationSpec> s("rotate", "A turn about an axis through the origin of the file.");
  s.vector("axis", &RotationSpec::axis).length(3).doc("Direction of the axis, of any length.");
  s.number("angle", &RotationSpec::angle, Unit::angle).doc("Angle, right-handed about the axis.");
  return s;
}

/// Keys of the shapes that stand in files, and of meshes.
void add_file_keys(Schema<ShapeSpec>& s) {
  s.text("file", &ShapeSpec::file)
      .when("type", {"mesh", "heightmap"})
      .doc(
          "Mesh: STL, OBJ, PLY, VTP, VTU, or anything that meshio reads (Gmsh .msh, Abaqus .inp, "
          "MED, ...); cells of "
          "space count as the surface around them. Heightmap: an ESRI ASCII raster (.asc). "
          "A relative path starts at the deck's folder.");
  s.text("region", &ShapeSpec::region)
      .when("type", {"mesh"})
      .fallback_text("all of the file")
      .doc(
          "A part of the file: a solid of an STL text, an object or group (OBJ), a physical group "
          "or set of cells (Gmsh, Abaqus, MED), `ARRAY=VALUE` of integers on cells (VTP, VTU).");
  s.number("scale", &ShapeSpec::scale)
      .above(0)
      .when("type", {"mesh", "heightmap"})
      .fallback(1.0)
      .doc("Metres per unit of the file: 0.001 for a file in mm.");
  s.table("rotate", &ShapeSpec::rotate, &rotation_schema)
      .when("type", {"mesh"})
      .fallback_text("none")
      .doc("Turn of the scaled file.");
  s.vector("translate", &ShapeSpec::translate, Unit::length)
      .when("type", {"mesh", "heightmap"})
      .fallback({0, 0, 0})
      .doc("Shift of the scaled and turned file; in 2D of the profile.");
  s.vector("extrude", &ShapeSpec::extrude, Unit::length)
      .when("type", {"mesh"})
      .fallback_text("none: the surface must be closed")
      .doc("Makes an open sheet a solid: the one between it and its copy moved by this vector.");
}

void add_heightmap_keys(Schema<ShapeSpec>& s) {
  s.number("base", &ShapeSpec::base, Unit::length)
      .when("type", {"heightmap"})
      .doc("Height of the flat bottom, below all of the surface.");
  s.number("no_data", &ShapeSpec::no_data)
      .when("type", {"heightmap"})
      .fallback_text("such cells are an error")
      .doc("Height of cells without data, in the unit of the file.");
  s.points("section", &ShapeSpec::section)
      .length(2)
      .in_dimension(2)
      .when("type", {"heightmap"})
      .fallback_text("the row of a raster that has only one")
      .doc(
          "Ends [x, y] of a line on the map, in the unit of the file; the profile along it has x = "
          "0 at the "
          "first one.");
}

Schema<ShapeSpec> make_schema() {
  Schema<ShapeSpec> s("shape", "A solid region of space, combined from simple ones.");
  s.choice("type", &ShapeSpec::kind, shape_kind_names())
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
  add_file_keys(s);
  add_heightmap_keys(s);
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

const Schema<RotationSpec>& rotation_schema() {
  static const Schema<RotationSpec> schema = make_rotation_schema();
  return schema;
}

const Schema<ShapeSpec>& shape_schema() {
  static const Schema<ShapeSpec> schema = make_schema();
  return schema;
}

}  // namespace scree
