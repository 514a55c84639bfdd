// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <sstream>

#include "solver/coupling/coupling_spec.hpp"

namespace scree {
namespace {

/// The first word that is neither an option with the prefix nor a value after one; "": none.
std::string foreign_option(const std::string& options) {
  std::istringstream words(options);
  std::string word;
  for (bool first = true; words >> word; first = false) {
    const bool number = word.size() > 1 && (std::isdigit(word[1]) != 0 || word[1] == '.');
    const bool option = word[0] == '-' && !number;
    if (option ? !word.starts_with("-scree_p_") : first) return word;
  }
  return "";
}

Schema<CouplingSpec> make_coupling_schema() {
  Schema<CouplingSpec> s("coupling",
                         "Water that flows in the pores of every material with a `porosity`, "
                         "coupled to the deformation of the soil both ways.");
  s.text("type", &CouplingSpec::type)
      .one_of({"biot"})
      .doc(
          "biot: one velocity, of the soil; the water's pressure is implicit, so that neither its "
          "stiffness nor the permeability limits the time step.");
  s.integer("pressure_spacing", &CouplingSpec::pressure_spacing)
      .at_least(1)
      .at_most(2)
      .fallback(2)
      .doc(
          "Cells between nodes of the pressure. 1 resolves drains better and costs more, much more "
          "in 3D; it needs the compact kernel, others are not stable with it.");
  s.number("tolerance", &CouplingSpec::tolerance)
      .above(0)
      .at_most(1e-3)
      .fallback(1e-8)
      .doc("Residual of the pressure solve over its right-hand side.");
  s.text("preconditioner", &CouplingSpec::preconditioner)
      .one_of({"icc", "jacobi", "gamg", "hypre", "ml"})
      .fallback_text("icc in 2D, jacobi in 3D")
      .doc("Preconditioner of the conjugate gradients, by PETSc's name.");
  s.entries().back()->write = [](const void* m, int) {
    const std::string& name = *static_cast<const std::string*>(m);
    return name.empty() ? name : toml_string(name);
  };
  s.text("solver_options", &CouplingSpec::solver_options)
      .fallback("")
      .doc(
          "Options of PETSc for the pressure solve, each with the prefix scree_p_: "
          "\"-scree_p_pc_type gamg -scree_p_ksp_monitor\".");
  s.integer("halvings", &CouplingSpec::halvings)
      .at_least(0)
      .at_most(20)
      .fallback(0)
      .doc(
          "A step whose pressure solve does not converge is repeated with half its length, so many "
          "times at most; then, with 0 at once, the run ends. Above 0 steps take separate passes "
          "over the particles, which cost some more.");
  s.integer("stride", &CouplingSpec::stride)
      .at_least(1)
      .at_most(1000)
      .fallback(64)
      .doc(
          "Steps in which particles may act on the grid from one place, so that the equations of "
          "the pressure need not be made anew; 1: they are in every step. Runs that take separate "
          "passes over the particles make them anew in every step whatever is given.");
  s.number("stride_drift", &CouplingSpec::stride_drift)
      .at_least(0)
      .at_most(0.05)
      .fallback(0.001)
      .doc(
          "Cells by which a particle may move meanwhile: before one is farther, all act from where "
          "they are by then.");
  s.number("water_table", &CouplingSpec::water_table, Unit::length)
      .fallback_text("not set")
      .doc(
          "Coordinate of the water table along the axis of gravity: pressure at the start is "
          "hydrostatic below it and zero above.");
  s.formula("initial_pressure", &CouplingSpec::initial_pressure, Unit::pressure, {"x", "y", "z"})
      .fallback_text("zero, or hydrostatic with water_table")
      .doc("Pressure at the start; not together with water_table.");
  s.check([](const CouplingSpec& spec, const SchemaContext&) -> std::optional<Finding> {
    if (!spec.water_table || !spec.initial_pressure.given()) return std::nullopt;
    return Finding{"water_table", "is given together with initial_pressure, which says the same",
                   "", "remove one of them"};
  });
  s.check({"solver_options"},
          [](const CouplingSpec& spec, const SchemaContext&) -> std::optional<Finding> {
            const std::string word = foreign_option(spec.solver_options);
            if (word.empty()) return std::nullopt;
            return Finding{"solver_options", "\"" + word + "\" is no option of the pressure solve",
                           "options that begin with -scree_p_", ""};
          });
  s.check({"pressure_spacing"},
          [](const CouplingSpec& spec, const SchemaContext& context) -> std::optional<Finding> {
            if (spec.pressure_spacing != 1 || context.kernel == "compact") return std::nullopt;
            return Finding{"pressure_spacing",
                           "1 is not stable with the " + context.kernel + " kernel", "2",
                           "set pressure_spacing = 2, or method.kernel = \"compact\""};
          });
  s.cite(
      "M. A. Biot, General theory of three-dimensional consolidation, Journal of Applied Physics "
      "12, 1941, doi 10.1063/1.1712886");
  return s;
}

Schema<DrainageSpec> make_drainage_schema() {
  const std::vector<std::string> variables{"x", "y", "z", "t"};
  Schema<DrainageSpec> s("drainage",
                         "Pore pressure or flux on the exposed faces of a body's particles; the "
                         "faces move with them. Every other surface is impermeable.");
  s.text("body", &DrainageSpec::body).doc("Name of the body.");
  s.table("region", &DrainageSpec::region, &shape_schema)
      .fallback_text("the whole surface")
      .doc("Holds the centres of the faces at t = 0, rim included.");
  s.vector("facing", &DrainageSpec::facing)
      .fallback({0, 0, 0})
      .doc("Only faces whose outward normal is within 60 degrees of this; zero: all.");
  s.flag("walls", &DrainageSpec::walls)
      .fallback(false)
      .doc("Also faces that lie on a closed face of the domain, as of a drained base.");
  s.choice("type", &DrainageSpec::type,
           {{"drained", DrainageType::drained},
            {"pressure", DrainageType::pressure},
            {"flux", DrainageType::flux}})
      .doc("drained: pressure zero; pressure: given; flux: given outflow, negative for inflow.");
  s.formula("value", &DrainageSpec::pressure, Unit::pressure, variables)
      .when("type", {"pressure"})
      .doc(
          "Pore pressure, at the face's present place. It does not load the surface: water that "
          "stands on it needs a [traction] too.");
  s.formula("value", &DrainageSpec::flux, Unit::velocity, variables)
      .when("type", {"flux"})
      .doc("Volume that flows out per area and time, at the face's present place.");
  return s;
}

}  // namespace

const Schema<CouplingSpec>& coupling_schema() {
  static const Schema<CouplingSpec> schema = make_coupling_schema();
  return schema;
}

const Schema<DrainageSpec>& drainage_schema() {
  static const Schema<DrainageSpec> schema = make_drainage_schema();
  return schema;
}

}  // namespace scree
