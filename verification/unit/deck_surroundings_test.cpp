// SPDX-License-Identifier: Apache-2.0
// Broken decks: faces, colliders, loads, output, syntax.
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

// clang-format off
const std::vector<BrokenDeck> cases{
    {24, R"~(x_min = "periodic")~",
     R"~(deck.toml:24:9: boundary.x_min = "periodic": a periodic face needs its opposite face periodic too; set x_max = "periodic")~"},
    {24, R"~(z_min = "slip")~",
     R"~(deck.toml:24:9: boundary.z_min = "slip": is not available with domain.dimension = 2; remove it, or set domain.dimension = 3)~"},
    {24, R"~(xmin = "slip")~",
     R"~(deck.toml:24:1: boundary.xmin = "slip": unknown key; allowed: x_min, x_max, y_min, y_max, no_slip; did you mean "x_min"?)~"},
    {24, R"~(no_slip = "faces")~",
     R"~(deck.toml:24:11: boundary.no_slip = "faces": unknown name; allowed: node, face; did you mean "face"?)~"},
    {25, R"~(y_min = "slip"
no_slip = "face")~",
     R"~(deck.toml:26:11: boundary.no_slip = "face": no_slip concerns sticky and friction faces, and there is none; delete no_slip, or make a face "sticky" or one with friction)~"},
    {24, R"~(x_min = "frictin")~",
     R"~(deck.toml:24:9: boundary.x_min.type = "frictin": unknown name; allowed: sticky, slip, separate, friction, open, periodic, symmetry; did you mean "friction"?)~"},
    {24, R"~(x_min = "absorbing")~",
     R"~(deck.toml:24:9: boundary.x_min.type = "absorbing": not available in this version; available: sticky, slip, separate, friction, open, periodic, symmetry)~"},
    {25, R"~(y_min = "friction")~",
     R"~(deck.toml:25:9: boundary.y_min.coefficient: required key is missing; add coefficient = ... to boundary.y_min)~"},
    {25, R"~(y_min = { type = "slip", coefficient = 0.6 })~",
     R"~(deck.toml:25:40: boundary.y_min.coefficient = 0.6: does not belong to type = "slip"; allowed: type; remove it, or set type to friction)~"},
    {25, R"~(y_min = { type = "friction", coefficient = -0.6 })~",
     R"~(deck.toml:25:44: boundary.y_min.coefficient = -0.6: is too small; allowed: at least 0)~"},
    {25, R"~([collider.c]
shape = { type = "sphere", center = [0.5, 0.1], radius = 0.05 }
velocity = ["0", "-0.01*x"]
contact = "slip")~",
     R"~(deck.toml:27:18: collider.c.velocity[1] = "-0.01*x": is no expression: unknown name "x" at character 7; allowed: an expression of t, pi)~"},
    {25, R"~([collider.c]
contact = "slip")~",
     R"~(deck.toml:25:1: collider.c.shape: required key is missing; add shape = { type = ... } to collider.c)~"},
    {25, R"~([traction.t]
body = "colum"
region = { type = "box", lower = [0, 0], upper = [1, 1] }
pressure = "1 kPa")~",
     R"~(deck.toml:26:8: traction.t.body = "colum": there is no [body.colum]; allowed: column; did you mean "column"?)~"},
    {25, R"~([traction.t]
body = "column"
region = { type = "box", lower = [0, 0], upper = [1, 1] })~",
     R"~(deck.toml:25:1: traction.t.pressure: a traction is given by exactly one of `pressure` and `value`; add one of them)~"},
    {25, R"~([traction.t]
body = "column"
region = { type = "box", lower = [0, 0], upper = [1, 1] }
pressure = 1
value = [1, 2])~",
     R"~(deck.toml:28:12: traction.t.pressure = 1: a traction is given by exactly one of `pressure` and `value`; delete one of them)~"},
    {25, R"~([traction.t]
body = "column"
region = { type = "box", lower = [0.3, 0.1], upper = [0.4, 0.2] }
pressure = "1 kPa")~",
     R"~(deck.toml:27:10: traction.t.region = { type = "box", lower = [0.3, 0.1], upper = [0.4, 0.2] }: holds no face of the body's surface, so that nothing is loaded; move or enlarge it until it holds centres of faces, or see `facing`)~"},
    {25, R"~([traction.t]
body = "column"
region = { type = "box", lower = [0, 0], upper = [1, 1] }
facing = [1, 0]
pressure = "1/t")~",
     R"~(deck.toml:29:12: traction.t.pressure = "1/t": "1/t" is not finite at the particle at [0.0991666667, 0.000833333333] m, t = 0)~"},
    {25, R"~([traction.t]
body = "column"
region = { type = "box", lower = [0, 0], upper = [1, 1] }
value = [0, "sqrt(-1)"])~",
     R"~(deck.toml:28:9: traction.t.value = [0, "sqrt(-1)"]: "sqrt(-1)" is not finite)~"},
    {25, R"~([traction.t]
body = "column"
region = { type = "box", lower = [0, 0], upper = [1, 1] }
pressure = "2 mPa")~",
     R"~(deck.toml:28:12: traction.t.pressure = "2 mPa": is in thousandths of a pascal; allowed: Pa, kPa, MPa, GPa, bar; did you mean "2 MPa"?)~"},
    {25, R"~([traction.t]
body = "column"
region = { type = "box", lower = [0, 0], upper = [1, 1] }
pressure = "1,5")~",
     R"~(deck.toml:28:12: traction.t.pressure = "1,5": is no number; allowed: a number in Pa or a quoted number with a unit (Pa, kPa, MPa, GPa, bar); write a decimal point: "1.5")~"},
    {27, R"~(every = 0)~",
     R"~(deck.toml:27:9: output.every = 0: is too small; allowed: above 0 s)~"},
    {27, R"~(every = "20 mm")~",
     R"~(deck.toml:27:9: output.every = "20 mm": has a unit that is not of a time; allowed: s, ms, us, min, h; write it in s)~"},
    {27, R"~(format = "vtk")~",
     R"~(deck.toml:27:10: output.format = "vtk": unknown name; allowed: vtu, xdmf, none; did you mean "vtu"?)~"},
    {27, R"~(precision = "half")~",
     R"~(deck.toml:27:13: output.precision = "half": unknown name; allowed: single, double)~"},
    {27, R"~(grid = 1)~",
     R"~(deck.toml:27:8: output.grid = 1: is an integer, must be a boolean; allowed: true, false)~"},
    {27, R"~(compression = "deflate")~",
     R"~(deck.toml:27:15: output.compression = "deflate": does not belong to format = "vtu"; allowed: every, format, precision, fields, grid, every_nth, region, from, until; remove it, or set format to xdmf)~"},
    {27, R"~(every_nth = 0)~",
     R"~(deck.toml:27:13: output.every_nth = 0: is too small; allowed: at least 1)~"},
    {27, R"~(from = 0.5
until = "0.4 s")~",
     R"~(deck.toml:28:9: output.until = "0.4 s": is before from, so there would be no frame; allowed: from or later)~"},
    {27, R"~(from = 2)~",
     R"~(deck.toml:27:8: output.from = 2: is after time.end, so there would be no frame; allowed: at most 1.0 s)~"},
    {25, R"~([frames.grid]
fields = ["p"])~",
     R"~(deck.toml:25:1: frames.grid = { fields = ["p"] }: there are other files called grid; choose another name)~"},
    {25, R"~([frames.toe]
format = "none")~",
     R"~(deck.toml:26:10: frames.toe.format = "none": unknown name; allowed: vtu, xdmf)~"},
    {25, R"~([probe.a]
type = "particle")~",
     R"~(deck.toml:25:1: probe.a.at: required key is missing; allowed: a length [m] for each axis; add at = ... or id = ...)~"},
    {25, R"~([probe.a]
at = [1.0, 0.1])~",
     R"~(deck.toml:26:6: probe.a.at = [1.0, 0.1]: lies outside of the domain; allowed: [0, 0] to [0.8, 0.3] m)~"},
    {25, R"~([probe.a]
type = "particle"
at = [0.1, 0.1]
id = 3)~",
     R"~(deck.toml:28:6: probe.a.id = 3: is given together with at, but either says which particle; remove one of them)~"},
    {25, R"~([profile.a]
from = [0.1, 0.1]
to = [0.1, 0.1])~",
     R"~(deck.toml:27:6: profile.a.to = [0.1, 0.1]: is the same as from, so the line has no length; move one of them)~"},
    {25, R"~([profile.a]
from = [0.9, 0.25]
to = [0.75, 0.4])~",
     R"~(deck.toml:26:8: profile.a.from = [0.9, 0.25]: the line to [0.75, 0.4] m lies outside of the domain; allowed: [0, 0] to [0.8, 0.3] m; move from or to)~"},
    {25, R"~([section.a]
region = { type = "sphere", center = [0.9, 0.1], radius = 0.05 })~",
     R"~(deck.toml:26:10: section.a.region = { type = "sphere", center = [0.9, 0.1], radius = 0.05 }: lies outside of the domain; allowed: shapes that meet [0, 0] to [0.8, 0.3] m)~"},
    {27, R"~(region = { type = "box", lower = [0.1, 0.4], upper = [0.2, 0.5] })~",
     R"~(deck.toml:27:10: output.region = { type = "box", lower = [0.1, 0.4], upper = [0.2, 0.5] }: lies outside of the domain; allowed: shapes that meet [0, 0] to [0.8, 0.3] m)~"},
    {25, R"~([section.a]
fields = ["presure"])~",
     R"~(deck.toml:26:11: section.a.fields[0] = "presure": is no field of the materials in use; allowed: id, material, body, velocity, stress, pressure, p, q, von_mises, lode_angle, principal_stress, principal_directions, mobilised_friction, yield_distance, equivalent_plastic_shear_strain, strain_rate, mass, volume, volume_ratio, displacement, deformation_gradient, volume_correction, equivalent_plastic_strain, log_volume_ratio; did you mean "pressure"?)~"},
    {28, R"~(fields = ["velocity", "stres"])~",
     R"~(deck.toml:28:23: output.fields[1] = "stres": is no field of the materials in use; allowed: id, material, body, velocity, stress, pressure, p, q, von_mises, lode_angle, principal_stress, principal_directions, mobilised_friction, yield_distance, equivalent_plastic_shear_strain, strain_rate, mass, volume, volume_ratio, displacement, deformation_gradient, volume_correction, equivalent_plastic_strain, log_volume_ratio; did you mean "stress"?)~"},
    {28, R"~(fields = ["velocity", "velocity"])~",
     R"~(deck.toml:28:23: output.fields[1] = "velocity": is named twice; remove it)~"},
    {28, R"~(fields = ["equivalent_plastic_strian"])~",
     R"~(deck.toml:28:11: output.fields[0] = "equivalent_plastic_strian": is no field of the materials in use; allowed: id, material, body, velocity, stress, pressure, p, q, von_mises, lode_angle, principal_stress, principal_directions, mobilised_friction, yield_distance, equivalent_plastic_shear_strain, strain_rate, mass, volume, volume_ratio, displacement, deformation_gradient, volume_correction, equivalent_plastic_strain, log_volume_ratio; did you mean "equivalent_plastic_strain"?)~"},
    {28, R"~(fields = "velocity")~",
     R"~(deck.toml:28:10: output.fields = "velocity": is a text, must be an array of texts; write [ "..." ])~"},
    {28, R"~(fields = ["velocity", 3])~",
     R"~(deck.toml:28:23: output.fields[1] = 3: is an integer, must be a text; write it in quotes)~"},
    {28, R"~([history]
every = -1)~",
     R"~(deck.toml:29:9: history.every = -1: is too small; allowed: above 0 s)~"},
    {28, R"~([checkpoint]
evry = 1)~",
     R"~(deck.toml:29:1: checkpoint.evry = 1: unknown key; allowed: every; did you mean "every"?)~"},
    {28, R"~([histroy]
every = 1)~",
     R"~(deck.toml:28:1: histroy = { every = 1 }: unknown key; allowed: title, domain, time, method, material, body, traction, coupling, drainage, boundary, collider, output, frames, history, probe, profile, section, checkpoint; did you mean "history"?)~"},
    {28, R"~([time])~",
     R"~(deck.toml:28:1: time: is defined twice; first in line 7; remove one of them)~"},
    {28, R"~(cell_size = 5 mm)~",
     R"~(deck.toml:28:15: is no TOML: invalid line format (expected newline, but got 'm'); one key = value a line; a number with a unit goes in quotes: "5 mm")~"},
    {28, R"~(x = [1, 2)~",
     R"~(deck.toml:28:5: is no TOML: missing array separator `,` after a value (should be `,`); close the array that begins here with ], and separate its entries by commas)~"},
    {28, R"~(fields = ["velocity])~",
     R"~(deck.toml:28:10: is no TOML: value having invalid format appeared in an array (it is not a valid value))~"},
    {28, R"~([output)~",
     R"~(deck.toml:28:1: is no TOML: an invalid key appeared (is not a valid key); write a table's header as [name])~"},
    {28, R"~(a = { b = 1,
c = 2 })~",
     R"~(deck.toml:28:13: is no TOML: an invalid key appeared (is not a valid key); a table in braces must stand on one line)~"},
    {28, R"~(every = "20 ms")~",
     R"~(deck.toml:28:9: every: is defined twice; first in line 27; remove one of them)~"},
    {28, R"~(fields = ["velocity", "stress"]
grid = true
x = 1e400)~",
     R"~(deck.toml:30:1: output.x = 1e400: unknown key; allowed: every, format, precision, fields, grid, every_nth, region, from, until; remove it)~"},
    {25, R"~([collider.c]
shape = { type = "sphere", center = [0.5, 0.1], radius = 0.05 }
velocity = ["1/t", 0]
contact = "slip")~",
     R"~(deck.toml:27:12: collider.c.velocity = ["1/t", 0]: "1/t" is not finite at t = 0)~"},
};
// clang-format on

class BrokenSurroundings : public BrokenDecks {};

TEST_P(BrokenSurroundings, IsReportedWordForWord) {
  EXPECT_EQ(problems_of(with_line(GetParam().line, GetParam().replacement)),
            GetParam().report + std::string("\n"));
}

INSTANTIATE_TEST_SUITE_P(Cases, BrokenSurroundings, testing::ValuesIn(cases));

}  // namespace
}  // namespace scree::testing_decks
