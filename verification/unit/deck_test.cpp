// SPDX-License-Identifier: Apache-2.0
// Whole decks: defaults, overrides, the resolved echo, files that are no decks, all problems at
// once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "materials/registry.hpp"
#include "solver/deck/document.hpp"
#include "verification/support/temporary_folder.hpp"
#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

namespace fs = std::filesystem;

Deck good(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Problems problems;
  Deck deck = read_deck_text(text, "deck.toml", overrides, problems);
  EXPECT_EQ(problems.text(), "");
  return deck;
}

/// As good_deck, with everything that a deck can say, in 3D.
const char* const full_deck = R"~(
title = "every key"
[domain]
dimension = 3
lower = [0.0, "-100 mm", 0.0]
upper = [0.4, 0.1, 0.2]
cell_size = "10 mm"
[time]
end = "500 ms"
step = "1e-5 s"
[method]
kernel = "quadratic"
transfer = "flip"
flip_blend = 0.9
precision = "single"
gravity = ["0.1 m/s^2", 0, "-9.81*min(t/2,1)"]
body_force = ["sin(pi*X)", 0, "x*t"]
damping = { type = "mass", value = "2 1/s" }
[material.rock]
model = "fixed_corotated"
density = "2.5 g/cm^3"
youngs_modulus = "1 GPa"
poissons_ratio = 0.2
[material.sand]
model = "drucker_prager"
density = 1600
youngs_modulus = "2 MPa"
poissons_ratio = 0.3
friction_angle = "31 deg"
cohesion = "1 kPa"
dilation_angle = "5 deg"
match = "extension"
[material.water]
model = "j_fluid"
density = 1000
bulk_modulus = "10 kPa"
gamma = 7
[body.a]
material = "rock"
particles_per_direction = 3
velocity = [1, "y + 2*x", "3 cm/s"]
[body.a.shape]
type = "difference"
of = [
  { type = "box", lower = [0, -0.1, 0], upper = [0.1, 0, 0.1] },
  { type = "union", of = [{ type = "sphere", center = [0, 0, 0], radius = "1 cm" },
    { type = "cylinder", from = [0, 0, 0], to = [0, 0, 1], radius = 0.01 }] } ]
[body.b]
material = "sand"
shape = { type = "polygon", points = [[0.2, 0], [0.3, 0], [0.3, 0.05]], z = [0.0, 0.1] }
[body.c]
material = "water"
shape = { type = "box", lower = [0.3, 0, 0], upper = [0.4, 0.1, 0.1] }
[traction.top]
body = "a"
region = { type = "plane", point = [0, 0, 0.09], normal = [0, 0, -1] }
pressure = "10 kPa"
[traction.side]
body = "b"
region = { type = "sphere", center = [0.2, 0, 0], radius = 1 }
facing = [1, 0, 0]
value = ["0", "-1e4*t", 5]
[boundary]
x_min = "periodic"
x_max = "periodic"
y_min = { type = "friction", coefficient = 0.3 }
y_max = "symmetry"
z_min = "sticky"
z_max = "open"
no_slip = "face"
[collider.plate]
shape = { type = "plane", point = [0, 0, 0.19], normal = [0, 0, -2] }
velocity = [0, 0, "-0.01*t"]
contact = { type = "friction", coefficient = 0.3 }
[collider.ball]
shape = { type = "sphere", center = [0.1, 0.05, 0.15], radius = 0.02 }
contact = "slip"
[output]
every = "20 ms"
precision = "double"
fields = ["velocity", "displacement", "equivalent_plastic_strain"]
grid = true
[history]
every = "1 ms"
[checkpoint]
every = "0.25 s"
)~";

TEST(Deck, FillsTheDocumentedDefaults) {
  const Deck deck = good(good_deck);
  EXPECT_EQ(deck.method.precision, Precision::double_);
  EXPECT_EQ(deck.method.damping.value, 0);
  EXPECT_EQ(deck.bodies[0].particles_per_direction, 3);
  EXPECT_EQ(deck.bodies[0].velocity[0].text, "0.0");
  EXPECT_EQ(deck.boundary.x_max.type, FaceType::open);
  EXPECT_EQ(deck.boundary.no_slip, NoSlip::node);
  EXPECT_EQ(deck.history.every, deck.output.every);
  EXPECT_FALSE(deck.checkpoint.every);
  EXPECT_EQ(deck.output.precision, FramePrecision::single_);
  EXPECT_EQ(deck.domain.cells, (std::array<int, 3>{160, 60, 1}));
  EXPECT_TRUE(deck.given.contains("time.cfl"));
  EXPECT_FALSE(deck.given.contains("history.every"));

  const Deck bare = good(with_line(27, ""), {"method.kernel=quadratic"});
  EXPECT_EQ(bare.output.every, bare.time.end);
  EXPECT_EQ(bare.history.every, bare.time.end);
  EXPECT_EQ(bare.bodies[0].particles_per_direction, 2);
}

TEST(Deck, ConvertsUnits) {
  const Deck deck = good(full_deck);
  EXPECT_EQ(deck.domain.lower[1], -0.1);
  EXPECT_EQ(deck.domain.cell_size, 0.01);
  EXPECT_EQ(deck.time.end, 0.5);
  EXPECT_EQ(deck.materials[0].density, 2500);
  EXPECT_EQ(deck.bodies[0].velocity[2].text, "0.03");
  EXPECT_EQ(deck.bodies[0].velocity[1].text, "y + 2*x");
  EXPECT_EQ(deck.method.damping.value, 2);
}

TEST(Deck, MatchDependsOnTheDimension) {
  const std::string echo = resolved_toml(good(good_deck));
  EXPECT_NE(echo.find("match = \"plane_strain\"  # default"), std::string::npos) << echo;
  std::string solid = full_deck;
  solid.erase(solid.find("match = \"extension\""), 19);
  const std::string echo3 = resolved_toml(good(solid));
  EXPECT_NE(echo3.find("match = \"compression\"  # default"), std::string::npos) << echo3;
}

TEST(Deck, KeepsTheOrderOfTheFile) {
  const Deck deck = good(full_deck);
  ASSERT_EQ(deck.bodies.size(), 3u);
  EXPECT_EQ(deck.bodies[0].name, "a");
  EXPECT_EQ(deck.bodies[2].name, "c");
  EXPECT_EQ(deck.materials[0].name, "rock");
  EXPECT_EQ(deck.tractions[1].name, "side");
  EXPECT_EQ(deck.colliders[0].name, "plate");
}

TEST(Deck, CitesTheModelsInUse) {
  const auto papers = citations(good(good_deck));
  EXPECT_TRUE(std::any_of(papers.begin(), papers.end(), [](const std::string& paper) {
    return paper.find("10.1145/3731155") != std::string::npos;  // CK-MPM
  }));
  EXPECT_TRUE(std::any_of(papers.begin(), papers.end(), [](const std::string& paper) {
    return paper.find("10.1145/2897824.2925906") != std::string::npos;  // Klar et al.
  }));
}

class RoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, ResolvedDeckReadsBackToTheSame) {
  const Deck deck = good(GetParam());
  const std::string echo = resolved_toml(deck);
  Deck again = good(echo);
  // All of it was given the second time; with the same marks the texts must agree in every digit.
  again.given = deck.given;
  EXPECT_EQ(resolved_toml(again), echo);
}

INSTANTIATE_TEST_SUITE_P(Decks, RoundTrip, testing::Values(good_deck, full_deck));

TEST(Resolved, MarksDefaultsOnly) {
  const std::string echo = resolved_toml(good(good_deck));
  EXPECT_NE(echo.find("cfl = 0.4\n"), std::string::npos) << echo;
  EXPECT_NE(echo.find("precision = \"double\"  # default\n"), std::string::npos) << echo;
  EXPECT_NE(echo.find("x_max.type = \"open\"  # default\n"), std::string::npos) << echo;
  EXPECT_NE(echo.find("history]\nevery = 0.02  # default\n"), std::string::npos) << echo;
  EXPECT_EQ(echo.find("z_min"), std::string::npos) << "a 2D deck has no z faces";
}

TEST(Override, PutsValuesInPlace) {
  const Deck deck = good(
      good_deck, {"time.end=2 s", "boundary.y_min.coefficient=0.1", "output.fields=[\"mass\"]",
                  "method.kernel=quadratic", "checkpoint.every=\"0.1 s\"", "title=Another name"});
  EXPECT_EQ(deck.time.end, 2);
  EXPECT_EQ(deck.boundary.y_min.coefficient, 0.1);
  EXPECT_EQ(deck.output.fields, std::vector<std::string>{"mass"});
  EXPECT_EQ(deck.method.kernel, KernelType::quadratic);
  EXPECT_EQ(deck.checkpoint.every, 0.1);
  EXPECT_EQ(deck.title, "Another name");
  EXPECT_TRUE(deck.given.contains("checkpoint.every"));
}

TEST(Override, ProblemsNameTheOption) {
  EXPECT_EQ(problems_of(good_deck, {"time.cfl=0.9"}),
            "--set time.cfl=0.9: time.cfl = 0.9: is too large; allowed: above 0 and at most 0.5\n");
  EXPECT_EQ(problems_of(good_deck, {"time.ende=2"}),
            "--set time.ende=2: time.ende = 2: unknown key; allowed: end, cfl, step; did you mean "
            "\"end\"?\n");
  EXPECT_EQ(problems_of(good_deck, {"time.end"}),
            "--set time.end: is no assignment; write --set KEY=VALUE, e.g. --set time.end=0.5\n");
  EXPECT_EQ(
      problems_of(good_deck, {"time..end=1"}),
      "--set time..end=1: has no valid key before the =; write a dotted key, e.g. time.end\n");
  EXPECT_EQ(problems_of(good_deck, {"boundary.x_min.type=slip"}),
            "--set boundary.x_min.type=slip: boundary.x_min is a text, not a table; set the whole "
            "table, e.g. --set 'boundary.x_min={ type = ... }'\n");
}

TEST(Override, NamesOfTablesThatAreNotThere) {
  EXPECT_EQ(problems_of(good_deck, {"material.sadn.friction_angle=0.5"}),
            "--set material.sadn.friction_angle=0.5: material.sadn: there is no [material.sadn]; "
            "allowed: sand; did you mean \"sand\"?\n");
  EXPECT_EQ(problems_of(good_deck, {"body.wall.velocity=[1, 0]"}),
            "--set body.wall.velocity=[1, 0]: body.wall: there is no [body.wall]; allowed: column; "
            "to make it, set also material, shape\n");
}

TEST(Override, MakesWholeTables) {
  const Deck deck = good(good_deck, {"body.colum.material=sand",
                                     "body.colum.shape={ type = \"box\", lower = [0.2, 0.0], "
                                     "upper = [0.3, 0.1] }"});
  ASSERT_EQ(deck.bodies.size(), 2u);
  EXPECT_EQ(deck.bodies[1].name, "colum");
}

TEST(Deck, ReportsAllProblemsAtOnceInTheOrderOfTheFile) {
  std::string text = good_deck;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("cfl = 0.4", "cfl = 0.6");
  replace("transfer = \"mls\"", "transfer = \"msl\"");
  replace("density = 1600", "density = \"18 kN/m^3\"");
  replace("material = \"sand\"", "material = \"snd\"");
  replace("upper = [0.1, 0.2]", "upper = [0.1, 0.9]");
  replace("\"stress\"]", "\"strain\"]");
  const std::string report = problems_of(text, {"output.evry=1"});
  std::istringstream lines(report);
  std::vector<std::string> begins;
  for (std::string line; std::getline(lines, line);) {
    begins.push_back(line.substr(0, line.find(" = ")));
  }
  EXPECT_EQ(begins,
            (std::vector<std::string>{
                "deck.toml:9:7: time.cfl", "deck.toml:12:12: method.transfer",
                "deck.toml:16:11: material.sand.density", "deck.toml:21:12: body.column.material",
                "deck.toml:22:9: body.column.shape", "deck.toml:28:23: output.fields[1]",
                "--set output.evry=1: output.evry"}))
      << report;
}

std::string file_problem(const std::string& path) {
  Problems problems;
  read_deck(path, {}, problems);
  return problems.text();
}

TEST(DeckFile, MissingDirectoryEmpty) {
  const TemporaryFolder folder;
  const fs::path base = folder.path();
  EXPECT_EQ(file_problem((base / "no.toml").string()),
            (base / "no.toml").string() + ": the deck does not exist\n");
  EXPECT_EQ(file_problem(base.string()),
            base.string() + ": the deck is a directory, must be a TOML file\n");
  const std::string empty = (base / "empty.toml").string();
  std::ofstream(empty) << " \n\n";
  EXPECT_EQ(file_problem(empty),
            empty +
                ": the deck is empty; begin with inputs/tutorial/sand_column_2d.toml, or see "
                "scree describe\n");
}

TEST(DeckProblems, AFaultyDimensionIsReportedAlone) {
  // Not also that a polygon in 3D would need z.
  EXPECT_EQ(
      problems_of(with_line(3, "dimension = 4"),
                  {"body.column.shape={type=\"polygon\", points=[[0, 0], [0.1, 0], [0, 0.1]]}"}),
      "deck.toml:3:13: domain.dimension = 4: is too large; allowed: at least 2 and at most 3\n");
}

TEST(DeckFile, MustBeUtf8) {
  const auto report = [](const std::string& text) {
    Problems problems;
    parse_document(text, "deck.toml", problems);
    return problems.text();
  };
  EXPECT_EQ(report("title = \"Böschung, 30°\"\n"), "");
  EXPECT_EQ(report("\xEF\xBB\xBFtitle = \"a\"\n"), "");  // a byte order mark of UTF-8
  EXPECT_EQ(report("# a\n# Stra\xDF"
                   "e\n"),
            "deck.toml:2:7: has a byte that is not UTF-8, 0xDF; save the deck as UTF-8\n");
  EXPECT_EQ(report("title = \"\xE2\x82"),
            "deck.toml:1:10: has a byte that is not UTF-8, 0xE2; save the deck as UTF-8\n");
  EXPECT_EQ(report(std::string("\xFF\xFEt\0", 4)),
            "deck.toml: is UTF-16 text; save the deck as UTF-8\n");
}

TEST(DeckFile, NestsAHundredLevelsAndNoMore) {
  const auto times = [](int count, const std::string& text) {
    std::string result;
    for (int i = 0; i < count; ++i) result += text;
    return result;
  };
  const std::string report =
      ": brackets or dotted keys nest too deep; allowed: at most 100 levels; close brackets that "
      "are open\n";
  // 20 000 levels overflow the stack of a parser that calls itself.
  EXPECT_EQ(problems_of("a = 1\nb = " + times(20000, "[")), "deck.toml:2:105" + report);
  EXPECT_EQ(problems_of(times(20000, "a.") + "a = 1"), "deck.toml:1:202" + report);
  EXPECT_EQ(problems_of("x = " + times(101, "{ a = ")), "deck.toml:1:605" + report);
  const std::string brackets = times(200, "[");
  const std::vector<std::string> titles{
      "title = \"\\\"" + brackets + "\"", "title = '" + brackets + "'",
      "title = \"\"\"\n\"" + brackets + "\"\"\"", "title = '''" + brackets + "'''",
      "title = \"a\" # " + brackets};
  for (const std::string& title : titles) {
    EXPECT_EQ(problems_of(with_line(1, title)), "") << title;
  }
  // As deep as allowed: read, and then not understood.
  EXPECT_EQ(problems_of(with_line(1, "title = " + times(100, "[") + times(100, "]")))
                .rfind("deck.toml:1:9: title = [[[", 0),
            0u);
}

TEST(DeckFile, NamesTheRun) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "my_deck.toml").string();
  std::ofstream(path) << good_deck;
  Problems problems;
  const Deck deck = read_deck(path, {}, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(deck.name, "my_deck");
  EXPECT_EQ(deck.path, path);
}

TEST(DeckFile, EveryDeckOfTheProjectIsGoodAndRoundTrips) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(SCREE_SOURCE_DIR "/inputs")) {
    if (entry.path().extension() != ".toml") continue;
    if (entry.path().parent_path().filename() == "element") continue;  // another kind of deck
    ++count;
    Problems problems;
    const Deck deck = read_deck(entry.path().string(), {}, problems);
    EXPECT_EQ(problems.text(), "");
    if (!problems.empty()) continue;
    Deck again = good(resolved_toml(deck));
    again.given = deck.given;
    EXPECT_EQ(resolved_toml(again), resolved_toml(deck)) << entry.path();
  }
  EXPECT_GE(count, 12);
}

}  // namespace
}  // namespace scree::testing_decks
