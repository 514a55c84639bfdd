// SPDX-License-Identifier: Apache-2.0
// Element decks: what is read, and every mistake word for word.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

#include "solver/base/error.hpp"
#include "solver/element/element_table.hpp"
#include "solver/element/element_test.hpp"

namespace scree {
namespace {

/// Tests count its lines from 1.
const char* const good_deck = R"(title = "base"
[material.sand]
model = "drucker_prager"
density = 1600
youngs_modulus = "10 MPa"
poissons_ratio = 0.2
friction_angle = "30 deg"
[path]
type = "triaxial_drained"
confining_pressure = "100 kPa"
strain = 0.1
steps = 100
)";

/// The good deck with another text in place of one line.
std::string with_line(int number, const std::string& replacement) {
  std::istringstream lines(good_deck);
  std::string text;
  int i = 0;
  for (std::string line; std::getline(lines, line);) {
    text += (++i == number ? replacement : line) + "\n";
  }
  return text;
}

ElementDeck read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Problems problems;
  ElementDeck deck = read_element_text(text, "folder/deck.toml", overrides, problems);
  EXPECT_EQ(problems.text(), "");
  return deck;
}

std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Problems problems;
  read_element_text(text, "deck.toml", overrides, problems);
  return problems.text();
}

struct BrokenElement {
  int line;
  const char* replacement;
  const char* report;
};
std::ostream& operator<<(std::ostream& stream, const BrokenElement& deck) {
  return stream << "line " << deck.line << ": " << deck.replacement;
}
class BrokenElements : public testing::TestWithParam<BrokenElement> {};

TEST_P(BrokenElements, IsReportedWordForWord) {
  EXPECT_EQ(problems_of(with_line(GetParam().line, GetParam().replacement)), GetParam().report);
}

#define KEYS_OF_TRIAXIAL                                                         \
  "allowed: type, strain, unload, cycles, confining_pressure, steps, duration, " \
  "initial_void_ratio; "

INSTANTIATE_TEST_SUITE_P(
    All, BrokenElements,
    testing::Values(
        BrokenElement{9, "type = \"triaxial\"",
                      "deck.toml:9:8: path.type = \"triaxial\": unknown name; allowed: isotropic, "
                      "oedometer, triaxial_drained, triaxial_undrained, simple_shear, gradient\n"},
        BrokenElement{10, "confining_pressure = \"-1 kPa\"",
                      "deck.toml:10:22: path.confining_pressure = \"-1 kPa\": is too small; "
                      "allowed: at least 0 Pa\n"},
        BrokenElement{10, "confining = 1",
                      "deck.toml:10:1: path.confining = 1: unknown key; " KEYS_OF_TRIAXIAL
                      "did you mean \"confining_pressure\"?\n"},
        BrokenElement{10, "gradient = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
                      "deck.toml:10:12: path.gradient = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]: does "
                      "not belong to type = \"triaxial_drained\"; " KEYS_OF_TRIAXIAL
                      "remove it, or set type to gradient\n"},
        BrokenElement{11, "",
                      "deck.toml:8:1: path.strain: required key is missing; add strain = ... to "
                      "path\n"},
        BrokenElement{11, "strain = 7",
                      "deck.toml:11:10: path.strain = 7: is too large; allowed: at least -5 and at "
                      "most 5\n"},
        BrokenElement{11, "strain = \"10 MPa\"",
                      "deck.toml:11:10: path.strain = \"10 MPa\": has a unit that is not of a "
                      "plain number; allowed: no unit, or %; write the number without a unit\n"},
        BrokenElement{12, "steps = 0",
                      "deck.toml:12:9: path.steps = 0: is too small; allowed: at least 1 and at "
                      "most 1e+07\n"},
        BrokenElement{12, "cycles = 3",
                      "deck.toml:12:10: path.cycles = 3: needs unload; add unload = ... to path\n"},
        BrokenElement{12, "normal_stress = 5",
                      "deck.toml:12:17: path.normal_stress = 5: does not belong to type = "
                      "\"triaxial_drained\"; " KEYS_OF_TRIAXIAL
                      "remove it, or set type to simple_shear\n"},
        BrokenElement{12, "duration = 0\nsteps = 1.5",
                      "deck.toml:12:12: path.duration = 0: is too small; allowed: above 0 s\n"
                      "deck.toml:13:9: path.steps = 1.5: is a number, must be an integer; allowed: "
                      "at least 1 and at most 1e+07\n"},
        BrokenElement{8, "[domain]\ndimension = 2\n[path]",
                      "deck.toml:8:1: domain = { dimension = 2 }: unknown key; allowed: title, "
                      "material, path; remove it\n"},
        BrokenElement{8,
                      "[material.two]\nmodel = \"drucker_prager\"\ndensity = 1\n"
                      "youngs_modulus = 1\npoissons_ratio = 0.1\nfriction_angle = 0.5\n[path]",
                      "deck.toml:8:1: material: has 2 materials; allowed: exactly one; remove the "
                      "others\n"},
        BrokenElement{4, "",
                      "deck.toml:2:1: material.sand.density: required key is missing; allowed: a "
                      "density [kg/m^3]; add density = ... to material.sand\n"}));

TEST(ElementDeckReading, MissingTablesAreNamed) {
  EXPECT_EQ(problems_of("title = \"a\"\n"),
            "deck.toml:1:1: material: required key is missing; add [material.NAME]\n"
            "deck.toml:1:1: path: required key is missing; add path = { type = ... }\n");
}

TEST(ElementDeckReading, GradientsMustKeepThePointWhole) {
  const auto with = [](const std::string& gradient) {
    std::string text = with_line(9, "type = \"gradient\"\ngradient = " + gradient);
    for (const char* line : {"strain = 0.1\n"})
      text.erase(text.find(line), std::string(line).size());
    return problems_of(text);
  };
  EXPECT_EQ(with("[[2, 1, 0], [0, 1, 0], [0, 0, 1]]"), "");
  EXPECT_EQ(with("[[1, 0, 0], [0, -1, 0], [0, 0, 1]]"),
            "deck.toml:10:12: path.gradient = [[1, 0, 0], [0, -1, 0], [0, 0, 1]]: its determinant "
            "is 0 after 0.5 of the way; allowed: above 0 on the straight way from the identity\n");
  EXPECT_EQ(with("[[1, 0], [0, 1]]"),
            "deck.toml:10:12: path.gradient = [[1, 0], [0, 1]]: must be an array of three rows; "
            "allowed: [[11, 12, 13], [21, 22, 23], [31, 32, 33]]\n");
  EXPECT_EQ(with("[[1, 0, 0], [0, 1, \"x\"], [0, 0, 1, 2]]"),
            "deck.toml:10:31: path.gradient[1][2] = \"x\": is not a number with a unit; allowed: a "
            "number\n"
            "deck.toml:10:37: path.gradient[2] = [0, 0, 1, 2]: has 4 entries; allowed: 3 "
            "numbers\n");
}

TEST(ElementDeckReading, AStrayStrainOfAGradientIsReportedOnce) {
  const std::string text =
      with_line(9, "type = \"gradient\"\ngradient = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
  EXPECT_EQ(
      problems_of(text),
      "deck.toml:12:10: path.strain = 0.1: does not belong to type = \"gradient\"; allowed: "
      "type, gradient, confining_pressure, steps, duration, initial_void_ratio; remove it, or "
      "set type to isotropic or oedometer or triaxial_drained or triaxial_undrained or "
      "simple_shear\n");
}

TEST(ElementDeckReading, ADrainedTestRefusesWaterThatCannotLeave) {
  const std::string text =
      with_line(7, "friction_angle = \"30 deg\"\nundrained_bulk_modulus = 2e9");
  EXPECT_EQ(problems_of(text),
            "deck.toml:8:26: material.sand.undrained_bulk_modulus = 2e9: keeps the water in the "
            "pores, but path.type = \"triaxial_drained\" drains it; remove it, or set path.type to "
            "triaxial_undrained\n");
  EXPECT_EQ(problems_of(text, {"path.type=triaxial_undrained"}), "");
}

TEST(ElementDeckReading, DefaultsAndOverrides) {
  const ElementDeck deck = read(good_deck, {"path.strain=\"5 %\"", "path.unload=0"});
  EXPECT_EQ(deck.name, "deck");
  EXPECT_EQ(deck.driven.type, LabTest::triaxial_drained);
  EXPECT_EQ(deck.driven.strain, 0.05);
  EXPECT_EQ(deck.driven.confining_pressure, 100e3);
  EXPECT_EQ(deck.driven.duration, 1);
  EXPECT_EQ(deck.driven.cycles, 1);
  EXPECT_EQ(deck.driven.initial_void_ratio, 0);
}

TEST(ElementTable, HasTheColumnsOfTheContractAndARowAStep) {
  const std::string csv = element_csv(drive_element(read(good_deck)));
  std::istringstream lines(csv);
  std::string header, line;
  std::getline(lines, header);
  EXPECT_EQ(header.rfind("step,strain_axial,strain_volumetric,strain_shear,p,q,sigma_1,sigma_2,"
                         "sigma_3,tau_12,void_ratio,",
                         0),
            0u)
      << header;
  EXPECT_NE(header.find(",equivalent_plastic_strain"), std::string::npos) << header;
  const auto commas = std::count(header.begin(), header.end(), ',');
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    EXPECT_EQ(line.rfind(std::to_string(rows) + ",", 0), 0u) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
    EXPECT_EQ(line.find("nan"), std::string::npos) << line;
  }
  EXPECT_EQ(rows, 101);
}

TEST(ElementTable, CyclesGoThereAndBack) {
  const ElementResult result =
      drive_element(read(good_deck, {"path.unload=0.02", "path.cycles=2", "path.steps=10"}));
  ASSERT_EQ(result.rows.size(), 41u);
  EXPECT_EQ(result.rows[10].strain.axial, 0.1);
  EXPECT_EQ(result.rows[20].strain.axial, 0.02);
  EXPECT_EQ(result.rows[30].strain.axial, 0.1);
  EXPECT_EQ(result.rows[40].strain.axial, 0.02);
  EXPECT_NEAR(result.rows[25].strain.axial, 0.06, 1e-15);
}

TEST(ElementTable, VoidRatioComesFromTheDeckWhereTheLawHasNone) {
  const ElementResult result = drive_element(read(good_deck, {"path.initial_void_ratio=0.7"}));
  EXPECT_TRUE(result.void_ratio_known);
  const auto ratio = [&](std::size_t i) { return 1 + result.rows[i].void_ratio; };
  EXPECT_NEAR(std::log(ratio(0) / ratio(100)), result.rows[100].strain.volumetric, 1e-12);
  // The confinement: p J = -K ln J.
  const double bulk = 10e6 / (3 * (1 - 2 * 0.2)), volume = ratio(0) / 1.7;
  EXPECT_NEAR(100e3 * volume, -bulk * std::log(volume), 1e-3);
}

/// A law that ends at a volume ratio of exp(-0.4) and a pressure of e^40 kPa.
const char* const limited = R"([material.water]
model = "j_fluid"
density = 1000
bulk_modulus = "1 kPa"
gamma = 100
[path]
type = "isotropic"
strain = 1
steps = 10
)";

std::string fault_of(const std::vector<std::string>& overrides, const char* deck = limited) {
  try {
    drive_element(read(deck, overrides));
  } catch (const RunFault& fault) {
    return fault.what();
  }
  return "none";
}

/// A clay whose void ratio of 1 is gone at a volumetric strain of ln 2 at the latest.
const char* const clay = R"([material.clay]
model = "modified_cam_clay"
density = 1800
m = 1.0
lambda = 0.2
kappa = 0.04
poissons_ratio = 0.3
reference_void_ratio = 1.0
initial_pressure = "100 kPa"
ocr = 1.0
[path]
type = "oedometer"
strain = 0.8
steps = 80
)";

TEST(ElementFaults, SayThatNoVoidsAreLeft) {
  for (const char* type : {"oedometer", "triaxial_drained"}) {
    const std::string fault = fault_of({std::string("path.type=") + type, "path.strain=2"}, clay);
    if (fault.find("not available in this") != std::string::npos) GTEST_SKIP();
    EXPECT_NE(fault.find("no voids are left (void ratio -"), std::string::npos) << fault;
  }
}

TEST(ElementFaults, NameStepAndCause) {
  EXPECT_EQ(
      fault_of({}),
      "step 4 of 10 of isotropic (strain 0.4): the law cannot represent this deformation; more "
      "path.steps or a smaller path.strain may help");
  EXPECT_EQ(
      fault_of({"path.confining_pressure=1e40"}),
      "step 1 of 200 of confinement: a pressure of 5e+37 Pa cannot be held, the nearest is 0 Pa: "
      "the law cannot represent the states on the way");
}

}  // namespace
}  // namespace scree
