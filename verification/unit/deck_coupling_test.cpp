// SPDX-License-Identifier: Apache-2.0
// Broken decks: pore water that flows.
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

/// The good deck with keys of its material and with tables of its own in place of line 23's, and
/// what must be reported, word for word.
struct WetDeck {
  const char* material;
  const char* tables;
  const char* report;
  int line = 0;  ///< another line that is replaced
  const char* replacement = "";
};

std::ostream& operator<<(std::ostream& stream, const WetDeck& deck) {
  return stream << deck.material << deck.tables << deck.replacement;
}

std::string text_of(const WetDeck& deck) {
  std::istringstream lines(good_deck);
  std::string text;
  int i = 0;
  for (std::string line; std::getline(lines, line);) {
    ++i;
    if (i == 23) text += deck.tables;
    text += (i == deck.line ? deck.replacement : line) + "\n";
    if (i == 19) text += deck.material;
  }
  return text;
}

constexpr const char* pores = "porosity = 0.4\nhydraulic_conductivity = 1e-5\n";

// clang-format off
const std::vector<WetDeck> cases{
    {pores, "[coupling]\ntype = \"biot\"\n", ""},
    {pores, "", R"~(deck.toml:20:12: material.sand.porosity = 0.4: water flows only with [coupling]; add [coupling] with type = "biot", or remove it)~"},
    {"", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:23:1: coupling: no material has a porosity, so that no water flows; set the porosity of a material, or remove [coupling])~"},
    {"porosity = 0.4\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:20:12: material.sand.porosity = 0.4: needs to know how easily water flows; add hydraulic_conductivity (m/s), or permeability (m^2) and fluid_viscosity (Pa s))~"},
    {"porosity = 0.4\npermeability = 1e-12\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:21:16: material.sand.permeability = 1e-12: needs fluid_viscosity; add fluid_viscosity (water: 1e-3 Pa s))~"},
    {"porosity = 0.4\nhydraulic_conductivity = 1e-5\npermeability = 1e-12\nfluid_viscosity = 1e-3\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:22:16: material.sand.permeability = 1e-12: is given together with hydraulic_conductivity, which says the same; keep either hydraulic_conductivity or permeability with fluid_viscosity)~"},
    {"fluid_density = 1000\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:20:17: material.sand.fluid_density = 1000: belongs to pores, but the material has no porosity; add porosity, or remove it)~"},
    {"porosity = 0.4\nhydraulic_conductivity = 1e-5\nundrained_bulk_modulus = 1e9\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:22:26: material.sand.undrained_bulk_modulus = 1e9: is water that stays, but porosity is water that flows; remove one of them)~"},
    {"porosity = 0.4\nhydraulic_conductivity = 1e-5\nbiot_coefficient = 0.3\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:22:20: material.sand.biot_coefficient = 0.3: is less than the porosity; allowed: at least 0.4 and at most 1; raise it)~"},
    {"porosity = 1.4\nhydraulic_conductivity = 1e-5\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:20:12: material.sand.porosity = 1.4: is too large; allowed: above 0 and below 1)~"},
    {"porosity = 0.9\nfluid_density = 1900\nhydraulic_conductivity = 1e-5\n", "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:16:11: material.sand.density = 1600: is that of soil and water together, but the water alone has more; allowed: above 1710.0 kg/m^3; give (1 - porosity) x density of the grains + porosity x fluid_density)~"},
    {pores, "[coupling]\ntype = \"biott\"\n",
     R"~(deck.toml:26:8: coupling.type = "biott": unknown name; allowed: biot; did you mean "biot"?)~"},
    {pores, "[coupling]\ntype = \"biot\"\npressure_spacing = 3\n",
     R"~(deck.toml:27:20: coupling.pressure_spacing = 3: is too large; allowed: at least 1 and at most 2)~"},
    {pores, "[coupling]\ntype = \"biot\"\npressure_spacing = 1\n",
     R"~(deck.toml:27:20: coupling.pressure_spacing = 1: 1 is not stable with the quadratic kernel; allowed: 2; set pressure_spacing = 2, or method.kernel = "compact")~",
     11, R"~(kernel = "quadratic")~"},
    {pores, "[coupling]\ntype = \"biot\"\npreconditioner = \"ilu\"\n",
     R"~(deck.toml:27:18: coupling.preconditioner = "ilu": unknown name; allowed: icc, jacobi, gamg, hypre, ml)~"},
    {pores, "[coupling]\ntype = \"biot\"\nhalvings = 21\n",
     R"~(deck.toml:27:12: coupling.halvings = 21: is too large; allowed: at least 0 and at most 20)~"},
    {pores, "[coupling]\ntype = \"biot\"\nstride = 0\n",
     R"~(deck.toml:27:10: coupling.stride = 0: is too small; allowed: at least 1 and at most 1000)~"},
    {pores, "[coupling]\ntype = \"biot\"\nstride_drift = 0.1\n",
     R"~(deck.toml:27:16: coupling.stride_drift = 0.1: is too large; allowed: at least 0 and at most 0.05)~"},
    {pores, "[coupling]\ntype = \"biot\"\nsolver_options = \"-scree_p_ksp_rtol 1e-9 -ksp_type minres\"\n",
     R"~(deck.toml:27:18: coupling.solver_options = "-scree_p_ksp_rtol 1e-9 -ksp_type minres": "-ksp_type" is no option of the pressure solve; allowed: options that begin with -scree_p_)~"},
    {pores, "[coupling]\ntype = \"biot\"\nsolver_options = \"-scree_p_ksp_rtoll 1e-9 -scree_p_ksp_max_it 50\"\n",
     R"~(deck.toml:27:18: coupling.solver_options = "-scree_p_ksp_rtoll 1e-9 -scree_p_ksp_max_it 50": PETSc does not know -scree_p_ksp_rtoll; correct or remove it, here or in the environment variable PETSC_OPTIONS)~"},
    {pores, "[coupling]\ntype = \"biot\"\nsolver_options = \"-scree_p_ksp_monitor -scree_p_pc_type gamg -scree_p_mg_levels_4_pc_type sor\"\n", ""},
    {pores, "[coupling]\ntype = \"biot\"\nwater_table = 0.1\ninitial_pressure = \"1 kPa\"\n",
     R"~(deck.toml:27:15: coupling.water_table = 0.1: is given together with initial_pressure, which says the same; remove one of them)~"},
    {pores, "[coupling]\ntype = \"biot\"\nwater_table = 0.1\n",
     R"~(deck.toml:27:15: coupling.water_table = 0.1: needs a method.gravity that is along one axis at t = 0; set method.gravity, or use initial_pressure)~",
     13, "gravity = [1.0, -9.81]"},
    {pores, "[coupling]\ntype = \"biot\"\ninitial_pressure = \"1/(x-x)\"\n",
     R"~(deck.toml:27:20: coupling.initial_pressure = "1/(x-x)": "1/(x-x)" is not finite at the particle at [0.000833333333, 0.000833333333] m)~"},
    {pores, "[coupling]\ntype = \"biot\"\n",
     R"~(deck.toml:13:11: method.damping = 0.1: local damping takes a share of the out-of-balance force, which is not known before the pressure is; allowed: mass; set damping = { type = "mass", value = ... } (1/s), or remove it)~",
     13, "damping = 0.1"},
    {pores, "[coupling]\ntype = \"biot\"\n[drainage.top]\nbody = \"colum\"\ntype = \"drained\"\n",
     R"~(deck.toml:28:8: drainage.top.body = "colum": there is no [body.colum]; allowed: column; did you mean "column"?)~"},
    {pores, "[coupling]\ntype = \"biot\"\n[drainage.top]\nbody = \"column\"\ntype = \"pressure\"\n",
     R"~(deck.toml:27:1: drainage.top.value: required key is missing; allowed: a pressure or stress [Pa]; add value = ... to drainage.top)~"},
    {pores, "[coupling]\ntype = \"biot\"\n[drainage.top]\nbody = \"column\"\ntype = \"drained\"\nvalue = \"1 kPa\"\n",
     R"~(deck.toml:30:9: drainage.top.value = "1 kPa": does not belong to type = "drained"; allowed: body, region, facing, walls, type; remove it, or set type to pressure or flux)~"},
    {pores, "[coupling]\ntype = \"biot\"\n[drainage.top]\nbody = \"column\"\ntype = \"flux\"\nvalue = \"1 kPa\"\n",
     R"~(deck.toml:30:9: drainage.top.value = "1 kPa": has a unit that is not of a velocity; allowed: m/s, mm/s, km/h; write it in m/s)~"},
    {pores, "[coupling]\ntype = \"biot\"\n[drainage.top]\nbody = \"column\"\ntype = \"drained\"\nregion = { type = \"box\", lower = [0.3, 0.0], upper = [0.4, 0.1] }\n",
     R"~(deck.toml:30:10: drainage.top.region = { type = "box", lower = [0.3, 0.0], upper = [0.4, 0.1] }: holds no free face of the body's surface, so that nothing drains; move or enlarge the region until it holds centres of faces; see `facing` and, for faces on a closed face of the domain, `walls`)~"},
    {pores, "[coupling]\ntype = \"biot\"\n[drainage.top]\nbody = \"column\"\nfacing = [0, 1]\ntype = \"drained\"\n[drainage.all]\nbody = \"column\"\ntype = \"flux\"\nvalue = 0\n",
     R"~(deck.toml:32:8: drainage.all.body = "column": holds faces that drainage.top holds too; choose regions or `facing` so that each face belongs to one of them)~"},
    {"", "[drainage.top]\nbody = \"column\"\ntype = \"drained\"\n",
     R"~(deck.toml:23:1: drainage.top: water flows only with [coupling]; add [coupling], or remove it)~"},
};
// clang-format on

class BrokenCoupling : public testing::TestWithParam<WetDeck> {};

TEST_P(BrokenCoupling, IsReportedWordForWord) {
  const std::string report = GetParam().report;
  EXPECT_EQ(problems_of(text_of(GetParam())), report.empty() ? report : report + "\n");
}

INSTANTIATE_TEST_SUITE_P(Cases, BrokenCoupling, testing::ValuesIn(cases));

}  // namespace
}  // namespace scree::testing_decks
