// SPDX-License-Identifier: Apache-2.0
// Broken decks: materials and bodies.
#include "materials/registry.hpp"
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

// clang-format off
const std::vector<BrokenDeck> cases{
    {14, R"~([material])~",
     R"~(deck.toml:14:1: material: holds values, must hold named tables; write [material.NAME] with a name of your choice)~"},
    {14, R"~([material."my sand"])~",
     R"~(deck.toml:14:1: material."my sand" = { model = "drucker_prager", density = 1600, youngs_modulus = "2 MPa...: the name is not usable in tables; allowed: letters, digits, _ and -; choose another name
deck.toml:21:12: body.column.material = "sand": there is no [material.sand]; allowed: my sand; add it, or name another)~"},
    {15, R"~(model = "druker_prager")~",
     R"~(deck.toml:15:9: material.sand.model = "druker_prager": unknown name; allowed: MODELS; did you mean "drucker_prager"?)~"},
    {15, R"~()~",
     R"~(deck.toml:14:1: material.sand.model: required key is missing; allowed: MODELS; add model = ... to material.sand)~"},
    {15, R"~(model = "mohr_coulomb"
cohesion = "10 kPa"
tension_cutoff = "20 kPa")~",
     R"~(deck.toml:17:18: material.sand.tension_cutoff = "20 kPa": lies beyond the apex of the pyramid and would do nothing; allowed: 0 to cohesion cot(friction_angle) = 16642.794824 Pa; lower it, or remove it)~"},
    {16, R"~(density = "18 kN/m^3")~",
     R"~(deck.toml:16:11: material.sand.density = "18 kN/m^3": has a unit that is not of a density; allowed: kg/m^3, g/cm^3, t/m^3; this is a weight per volume; divide it by g = 9.81 m/s^2: "1834.9 kg/m^3")~"},
    {16, R"~(density = -5)~",
     R"~(deck.toml:16:11: material.sand.density = -5: is too small; allowed: above 0 kg/m^3)~"},
    {16, R"~()~",
     R"~(deck.toml:14:1: material.sand.density: required key is missing; allowed: a density [kg/m^3]; add density = ... to material.sand)~"},
    {17, R"~(youngs_modulus = "2 Mpa")~",
     R"~(deck.toml:17:18: material.sand.youngs_modulus = "2 Mpa": has the unknown unit "Mpa"; allowed: Pa, kPa, MPa, GPa, bar; did you mean "MPa"?)~"},
    {18, R"~(poissons_ratio = 0.5)~",
     R"~(deck.toml:18:18: material.sand.poissons_ratio = 0.5: is too large; allowed: above -1 and below 0.5)~"},
    {19, R"~(friction_angle = 31)~",
     R"~(deck.toml:19:18: material.sand.friction_angle = 31: is too large; allowed: at least 0 deg and below 90 deg; a bare number is in radians; for degrees write "31 deg")~"},
    {19, R"~(friction_angle = "31 deg"
friction = 0.3)~",
     R"~(deck.toml:20:1: material.sand.friction = 0.3: unknown key; allowed: model, density, undrained_bulk_modulus, youngs_modulus, poissons_ratio, friction_angle, cohesion, dilation_angle, match, h0, h1, h2, h3; did you mean "friction_angle"?)~"},
    {19, R"~(friction_angle = 0)~",
     R"~(deck.toml:19:18: material.sand.friction_angle = 0: a cone without friction has no tip; allowed: above 0; use model = "von_mises", whose yield_stress is sqrt(3) times the cohesion in plane strain, twice the cohesion in triaxial states)~"},
    {19, R"~(friction_angle = "31 deg"
match = "plain_strain")~",
     R"~(deck.toml:20:9: material.sand.match = "plain_strain": unknown name; allowed: compression, extension, plane_strain; did you mean "plane_strain"?)~"},
    {19, R"~(friction_angle = "31 deg"
dilation_angle = "40 deg")~",
     R"~(deck.toml:20:18: material.sand.dilation_angle = "40 deg": dilation above friction would create energy; allowed: 0 to friction_angle; lower dilation_angle or raise friction_angle)~"},
    {19, R"~(bulk_modulus = 3)~",
     R"~(deck.toml:14:1: material.sand.friction_angle: required key is missing; allowed: an angle [rad], or friction hardening by h0, h1, h2 and h3; add friction_angle = ...
deck.toml:19:1: material.sand.bulk_modulus = 3: unknown key; allowed: model, density, undrained_bulk_modulus, youngs_modulus, poissons_ratio, friction_angle, cohesion, dilation_angle, match, h0, h1, h2, h3; remove it)~"},
    {20, R"~([bodie.column])~",
     R"~(deck.toml:1:1: body: required key is missing; add [body.NAME]
deck.toml:20:1: bodie = { column = { material = "sand", shape = { type = "box", lower = [0....: unknown key; allowed: title, domain, time, method, material, body, traction, boundary, collider, output, history, checkpoint; remove it)~"},
    {21, R"~(material = "snad")~",
     R"~(deck.toml:21:12: body.column.material = "snad": there is no [material.snad]; allowed: sand; did you mean "sand"?)~"},
    {21, R"~()~",
     R"~(deck.toml:20:1: body.column.material: required key is missing; add material = ... to body.column)~"},
    {22, R"~(shape = "box")~",
     R"~(deck.toml:22:9: body.column.shape = "box": is a text, must be a table; allowed: type, lower, upper, center, from, to, radius, points, z, point, normal, of; write { type = ... })~"},
    {22, R"~(shape = { type = "bx", lower = [0.0, 0.0], upper = [0.1, 0.2] })~",
     R"~(deck.toml:22:18: body.column.shape.type = "bx": unknown name; allowed: box, sphere, cylinder, polygon, plane, union, difference, intersection; did you mean "box"?)~"},
    {22, R"~(shape = { type = "box", lower = [0.0, 0.0], uper = [0.1, 0.2] })~",
     R"~(deck.toml:22:9: body.column.shape.upper: required key is missing; allowed: a length [m]; is it meant by the unknown key "uper"?
deck.toml:22:45: body.column.shape.uper = [0.1, 0.2]: unknown key; allowed: type, lower, upper; did you mean "upper"?)~"},
    {22, R"~(shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.4] })~",
     R"~(deck.toml:22:9: body.column.shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.4] }: reaches from [0, 0] to [0.1, 0.4] m, out of the domain; allowed: [0, 0] to [0.8, 0.3] m; move or shrink the shape, or enlarge the domain)~"},
    {22, R"~(shape = { type = "box", lower = [0.2, 0.0], upper = [0.1, 0.2] })~",
     R"~(deck.toml:22:53: body.column.shape.upper = [0.1, 0.2]: the upper corner must lie above the lower one in every axis)~"},
    {22, R"~(shape = { type = "box", lower = [0.0, 0.0], upper = [0.0005, 0.0005] })~",
     R"~(deck.toml:22:9: body.column.shape = { type = "box", lower = [0.0, 0.0], upper = [0.0005, 0.0005] }: holds no particle; enlarge the shape, lower domain.cell_size (particles are cell_size / particles_per_direction = 0.0016666666666666668 m apart), or raise particles_per_direction)~"},
    {22, R"~(shape = { type = "sphere", center = [0.1, 0.1], radius = -1 })~",
     R"~(deck.toml:22:58: body.column.shape.radius = -1: is too small; allowed: above 0 m)~"},
    {22, R"~(shape = { type = "mesh", file = "a.stl" })~",
     R"~(deck.toml:22:18: body.column.shape.type = "mesh": a mesh bounds a solid of three dimensions; with domain.dimension = 2 give the outline as a polygon)~"},
    {22, R"~(shape = { type = "polygon", points = [[0, 0], [0.1, 0]] })~",
     R"~(deck.toml:22:38: body.column.shape.points = [[0, 0], [0.1, 0]]: must be an array of at least three points; allowed: [[x, y], [x, y], [x, y]])~"},
    {22, R"~(shape = { type = "polygon", points = [[0, 0], [0.1, 0], [0.1, 0.1]], z = [0, 1] })~",
     R"~(deck.toml:22:74: body.column.shape.z = [0, 1]: is not available with domain.dimension = 2; remove it, or set domain.dimension = 3)~"},
    {22, R"~(shape = { type = "plane", point = [0.1, 0.1], normal = [0, 1] })~",
     R"~(deck.toml:22:9: body.column.shape = { type = "plane", point = [0.1, 0.1], normal = [0, 1] }: is unbounded; combine the plane with a bounded shape)~"},
    {22, R"~(shape = { type = "union", of = [{ type = "sphere", center = [0.1, 0.1], radus = 0.05 }] })~",
     R"~(deck.toml:22:33: body.column.shape.of[0].radius: required key is missing; allowed: a length [m]; is it meant by the unknown key "radus"?
deck.toml:22:73: body.column.shape.of[0].radus = 0.05: unknown key; allowed: type, center, radius; did you mean "radius"?)~"},
    {22, R"~(shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.2] }
particles_per_direction = 0)~",
     R"~(deck.toml:23:27: body.column.particles_per_direction = 0: is too small; allowed: at least 1 and at most 16)~"},
    {22, R"~(shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.2] }
velocity = [0.0, "t"])~",
     R"~(deck.toml:23:18: body.column.velocity[1] = "t": is no expression: unknown name "t" at character 1; allowed: an expression of x, y, z, pi)~"},
    {22, R"~(shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.2] }
velocity = [0, "log(0.1 - y)"])~",
     R"~(deck.toml:23:12: body.column.velocity = [0, "log(0.1 - y)"]: "log(0.1 - y)" is not finite at the particle at [0.000833333333, 0.100833333] m)~"},
    {22, R"~(shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.2] }
velocity = ["x", "sqrt(-1)"])~",
     R"~(deck.toml:23:12: body.column.velocity = ["x", "sqrt(-1)"]: "sqrt(-1)" is not finite)~"},
    {22, R"~(shape = { type = "polygon", points = [[0, 0], [0.1, 0.1], [0.1, 0], [0, 0.15]] })~",
     R"~(deck.toml:22:38: body.column.shape.points = [[0, 0], [0.1, 0.1], [0.1, 0], [0, 0.15]]: the sides 1 and 3 cross; give the corners in the order of the outline)~"},
    {22, R"~(shape = { type = "polygon", points = [[0, 0], [0.1, 0.1], [0.1, 0], [0, 0.1]] })~",
     R"~(deck.toml:22:38: body.column.shape.points = [[0, 0], [0.1, 0.1], [0.1, 0], [0, 0.1]]: the sides 1 and 3 cross; give the corners in the order of the outline)~"},
    {17, R"~(youngs_modulus = "2 mPa")~",
     R"~(deck.toml:17:18: material.sand.youngs_modulus = "2 mPa": is in thousandths of a pascal; allowed: Pa, kPa, MPa, GPa, bar; did you mean "2 MPa"?)~"},
    {22, R"~(shape = { type = "box", lower = ["0,0 mm", 0], upper = [0.1, 0.2] })~",
     R"~(deck.toml:22:34: body.column.shape.lower[0] = "0,0 mm": is not a number with a unit; allowed: a number in m or a quoted number with a unit (m, mm, cm, km); write a decimal point: "0.0 mm")~"},
};
// clang-format on

class BrokenMaterial : public BrokenDecks {};

/// MODELS stands for the models of this build.
std::string with_models(std::string report) {
  std::vector<std::string> names;
  for (const MaterialEntry& model : material_registry()) names.push_back(model.name);
  const std::size_t at = report.find("MODELS");
  return at == std::string::npos ? report : report.replace(at, 6, join(names));
}

TEST_P(BrokenMaterial, IsReportedWordForWord) {
  EXPECT_EQ(problems_of(with_line(GetParam().line, GetParam().replacement)),
            with_models(GetParam().report) + "\n");
}

INSTANTIATE_TEST_SUITE_P(Cases, BrokenMaterial, testing::ValuesIn(cases));

}  // namespace
}  // namespace scree::testing_decks
