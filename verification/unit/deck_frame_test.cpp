// SPDX-License-Identifier: Apache-2.0
// Broken decks: domain, time and method.
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

// clang-format off
const std::vector<BrokenDeck> cases{
    {3, R"~(dimension = 4)~",
     R"~(deck.toml:3:13: domain.dimension = 4: is too large; allowed: at least 2 and at most 3)~"},
    {3, R"~(dimension = 3)~",
     R"~(deck.toml:4:9: domain.lower = [0.0, 0.0]: has 2 entries; allowed: 3 numbers (domain.dimension)
deck.toml:5:9: domain.upper = [0.8, 0.3]: has 2 entries; allowed: 3 numbers (domain.dimension)
deck.toml:13:11: method.gravity = [0.0, -9.81]: has 2 entries; allowed: 3 numbers or expressions (domain.dimension)
deck.toml:22:33: body.column.shape.lower = [0.0, 0.0]: has 2 entries; allowed: 3 numbers (domain.dimension)
deck.toml:22:53: body.column.shape.upper = [0.1, 0.2]: has 2 entries; allowed: 3 numbers (domain.dimension))~"},
    {3, R"~()~",
     R"~(deck.toml:2:1: domain.dimension: required key is missing; add dimension = ... to domain)~"},
    {4, R"~(lower = [0.0, 0.0, 0.0])~",
     R"~(deck.toml:4:9: domain.lower = [0.0, 0.0, 0.0]: has 3 entries; allowed: 2 numbers (domain.dimension); remove the third entry, or set domain.dimension = 3)~"},
    {4, R"~(lower = [0.0, "a"])~",
     R"~(deck.toml:4:15: domain.lower[1] = "a": is not a number with a unit; allowed: a number in m or a quoted number with a unit (m, mm, cm, km))~"},
    {5, R"~(upper = [0.803, 0.3])~",
     R"~(deck.toml:5:9: domain.upper = [0.803, 0.3]: upper - lower = 0.803 m in x is no multiple of cell_size = 0.005 m (160.6 cells); allowed: upper = [0.8, 0.3] or upper = [0.805, 0.3])~"},
    {5, R"~(upper = [0.0, 0.3])~",
     R"~(deck.toml:5:9: domain.upper = [0.0, 0.3]: is not above domain.lower in x; allowed: more than 0)~"},
    {5, R"~(upper = [0.802, 0.301])~",
     R"~(deck.toml:5:9: domain.upper = [0.802, 0.301]: upper - lower = 0.802 m in x is no multiple of cell_size = 0.005 m (160.4 cells); allowed: upper = [0.8, 0.3] or upper = [0.805, 0.3]
deck.toml:5:9: domain.upper = [0.802, 0.301]: upper - lower = 0.301 m in y is no multiple of cell_size = 0.005 m (60.2 cells); allowed: upper = [0.8, 0.3] or upper = [0.8, 0.305])~"},
    {6, R"~(cell_size = "5 kPa")~",
     R"~(deck.toml:6:13: domain.cell_size = "5 kPa": has a unit that is not of a length; allowed: m, mm, cm, km; write it in m)~"},
    {6, R"~(cell_size = 0)~",
     R"~(deck.toml:6:13: domain.cell_size = 0: is too small; allowed: above 0 m)~"},
    {6, R"~(cell_size = 1e-9)~",
     R"~(deck.toml:6:13: domain.cell_size = 1e-9: gives 800000000 cells in x; allowed: at most 1000000 cells an axis; enlarge the cells
deck.toml:6:13: domain.cell_size = 1e-9: gives 300000000 cells in y; allowed: at most 1000000 cells an axis; enlarge the cells)~"},
    {6, R"~(cel_size = 0.005)~",
     R"~(deck.toml:2:1: domain.cell_size: required key is missing; allowed: a length [m]; is it meant by the unknown key "cel_size"?
deck.toml:6:1: domain.cel_size = 0.005: unknown key; allowed: dimension, lower, upper, cell_size; did you mean "cell_size"?)~"},
    {7, R"~([tim])~",
     R"~(deck.toml:1:1: time: required key is missing; is it meant by the unknown key "tim"?
deck.toml:7:1: tim = { end = 1.0, cfl = 0.4 }: unknown key; allowed: title, domain, time, method, material, body, traction, coupling, drainage, boundary, collider, output, frames, history, probe, profile, section, checkpoint; did you mean "time"?)~"},
    {8, R"~(end = -1)~",
     R"~(deck.toml:8:7: time.end = -1: is too small; allowed: above 0 s)~"},
    {8, R"~(end = inf)~",
     R"~(deck.toml:8:7: time.end = inf: is not finite; allowed: above 0 s; write a finite number)~"},
    {8, R"~(end = "1 m")~",
     R"~(deck.toml:8:7: time.end = "1 m": has a unit that is not of a time; allowed: s, ms, us, min, h; write it in s)~"},
    {9, R"~(cfl = 0.6)~",
     R"~(deck.toml:9:7: time.cfl = 0.6: is too large; allowed: above 0 and at most 0.5)~"},
    {9, R"~(cfl = 0.4
step = 1e-5)~",
     R"~(deck.toml:10:8: time.step = 1e-5: is given together with time.cfl, but either fixes the step; remove one of them)~"},
    {9, R"~(step = "-1 s")~",
     R"~(deck.toml:9:8: time.step = "-1 s": is too small; allowed: above 0 s)~"},
    {11, R"~(kernel = "linear")~",
     R"~(deck.toml:11:10: method.kernel = "linear": the linear kernel cannot be combined with transfer mls or apic, because its matrix D is singular where a particle meets a node; allowed: compact, quadratic; or set transfer = "flip" or "pic")~"},
    {11, R"~(kernel = "compct")~",
     R"~(deck.toml:11:10: method.kernel = "compct": unknown name; allowed: compact, quadratic, linear; did you mean "compact"?)~"},
    {11, R"~(transfer = "apic")~",
     R"~(deck.toml:12:12: transfer: is defined twice; first in line 11; remove one of them)~"},
    {12, R"~(transfer = "flip"
flip_blend = 1.5)~",
     R"~(deck.toml:13:14: method.flip_blend = 1.5: is too large; allowed: at least 0 and at most 1)~"},
    {12, R"~(flip_blend = 0.9)~",
     R"~(deck.toml:12:14: method.flip_blend = 0.9: does not belong to transfer = "mls"; allowed: kernel, transfer, precision, volumetric_locking, deterministic, gravity, body_force, damping; remove it, or set transfer to flip)~"},
    {12, R"~(precision = "float")~",
     R"~(deck.toml:12:13: method.precision = "float": unknown name; allowed: double, single)~"},
    {13, R"~(gravity = [0.0, "9.81 m/s"])~",
     R"~(deck.toml:13:17: method.gravity[1] = "9.81 m/s": has a unit that is not of an acceleration; allowed: m/s^2, cm/s^2; write it in m/s^2)~"},
    {13, R"~(gravity = [0.0, "-9.81*mn(t,1)"])~",
     R"~(deck.toml:13:17: method.gravity[1] = "-9.81*mn(t,1)": is no expression: unknown name "mn" at character 7 (did you mean "ln"?); allowed: an expression of t, pi)~"},
    {13, R"~(gravity = [0.0, "1/t"])~",
     R"~(deck.toml:13:11: method.gravity = [0.0, "1/t"]: "1/t" is not finite at t = 0)~"},
    {13, R"~(gravity = "down")~",
     R"~(deck.toml:13:11: method.gravity = "down": is a text, must be an array; allowed: 2 numbers or expressions (domain.dimension))~"},
    {13, R"~(damping = 1.5)~",
     R"~(deck.toml:13:11: method.damping.value = 1.5: is too large; allowed: at least 0 and below 1)~"},
    {13, R"~(damping = { type = "mas", value = 1 })~",
     R"~(deck.toml:13:20: method.damping.type = "mas": unknown name; allowed: local, mass; did you mean "mass"?)~"},
    {13, R"~(damping = { type = "mass", value = "2 s" })~",
     R"~(deck.toml:13:36: method.damping.value = "2 s": has a unit that is not of a rate; allowed: 1/s, Hz; write it in 1/s)~"},
    {13, R"~(body_force = ["q", "0"])~",
     R"~(deck.toml:13:15: method.body_force[0] = "q": is no expression: unknown name "q" at character 1; allowed: an expression of X, Y, Z, x, y, z, t, pi)~"},
    {6, R"~(cell_size = "5 MM")~",
     R"~(deck.toml:6:13: domain.cell_size = "5 MM": has the unknown unit "MM"; allowed: m, mm, cm, km; did you mean "mm"?)~"},
    {13, R"~(damping = true)~",
     R"~(deck.toml:13:11: method.damping = true: is a boolean, must be a table; allowed: type, value; write { type = ... })~"},
    {13, R"~(body_force = ["1/(X - 0.1*t)", "sqrt(x - 0.05)"])~",
     R"~(deck.toml:13:14: method.body_force = ["1/(X - 0.1*t)", "sqrt(x - 0.05)"]: "sqrt(x - 0.05)" is not finite at the particle at [0.000833333333, 0.000833333333] m, t = 0)~"},
    {13, R"~(body_force = ["1/0", 0])~",
     R"~(deck.toml:13:14: method.body_force = ["1/0", 0]: "1/0" is not finite)~"},
    {13, R"~(body_force = [0, "1/t"])~",
     R"~(deck.toml:13:14: method.body_force = [0, "1/t"]: "1/t" is not finite at the particle at [0.000833333333, 0.000833333333] m, t = 0)~"},
};
// clang-format on

class BrokenFrame : public BrokenDecks {};

TEST_P(BrokenFrame, IsReportedWordForWord) {
  EXPECT_EQ(problems_of(with_line(GetParam().line, GetParam().replacement)),
            GetParam().report + std::string("\n"));
}

INSTANTIATE_TEST_SUITE_P(Cases, BrokenFrame, testing::ValuesIn(cases));

}  // namespace
}  // namespace scree::testing_decks
