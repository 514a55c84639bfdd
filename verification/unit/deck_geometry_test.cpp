// SPDX-License-Identifier: Apache-2.0
// Decks that name files of geometry.
#include <gtest/gtest.h>

#include "app/build_simulation.hpp"
#include "app/deck_warnings.hpp"
#include "solver/deck/deck.hpp"
#include "verification/support/meshes.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

constexpr const char* head = R"(title = "mesh"
[domain]
dimension = 3
lower = [0, 0, 0]
upper = [2, 2, 2]
cell_size = 0.25
[time]
end = 1.0
[material.rock]
model = "hencky"
density = 2000
youngs_modulus = "1 MPa"
poissons_ratio = 0.3
[body.stone]
material = "rock"
)";

class DeckGeometry : public ::testing::Test {
 protected:
  Deck read(const std::string& shape) {
    std::filesystem::create_directories(folder_ / "decks");
    write_text(folder_ / "decks" / "deck.toml", std::string(head) + "shape = " + shape + "\n");
    problems_ = Problems();
    return read_deck((folder_ / "decks" / "deck.toml").string(), {}, problems_);
  }
  /// The report from the deck's name on, with the folder's name left out.
  std::string report(const std::string& shape) {
    read(shape);
    std::string text = problems_.text();
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;)
      text.erase(at, folder.size());
    return text;
  }
  void write(const std::string& name, const std::string& text) { write_text(folder_ / name, text); }

  TemporaryFolder folder_;
  Problems problems_;
};

TEST_F(DeckGeometry, ARelativePathStartsAtTheDeck) {
  write("stone.stl", testing::binary_stl(testing::box_mesh({0, 0, 0}, {1, 1.5, 0.5})));
  const Deck deck =
      read(R"({ type = "mesh", file = "../stone.stl", translate = [0.5, "25 cm", 1.0] })");
  ASSERT_EQ(problems_.text(), "");
  EXPECT_EQ(deck.bodies[0].shape.file, (folder_ / "stone.stl").string());
  const SimulationSetup setup = build_setup(deck);
  // 0.75 m^3 in cells of 0.25 m with 27 particles each.
  EXPECT_EQ(setup.bodies[0].position.size(), 3u * 27 * 4 * 6 * 2);
  EXPECT_TRUE(deck_warnings(deck, setup).empty());
  EXPECT_EQ(masses_text(deck, setup), "stone 1500 kg (shape 1500)");
}

TEST_F(DeckGeometry, TheResolvedDeckReadsBack) {
  write("stone.stl", testing::ascii_stl(testing::box_mesh({0, 0, 0}, {1, 1, 1}), "top"));
  const Deck deck = read(
      R"({ type = "union", of = [
    { type = "mesh", file = "../stone.stl", region = "top", scale = 0.5, rotate = { axis = [0, 0, 1], angle = "30 deg" }, translate = [1, 1, 1] },
    { type = "box", lower = [0, 0, 0], upper = [1, 1, 1] } ] })");
  ASSERT_EQ(problems_.text(), "");
  Problems problems;
  const Deck again = read_deck_text(resolved_toml(deck), "elsewhere.toml", {}, problems);
  ASSERT_EQ(problems.text(), "");
  const ShapeSpec &a = deck.bodies[0].shape.of[0], &b = again.bodies[0].shape.of[0];
  EXPECT_EQ(a.file, b.file);
  EXPECT_EQ(a.region, b.region);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.translate, b.translate);
  ASSERT_TRUE(b.rotate);
  EXPECT_EQ(a.rotate->angle, b.rotate->angle);
}

TEST_F(DeckGeometry, DefectsAreNamedAtTheirPlace) {
  TriangleMesh open = testing::box_mesh({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  write("open.obj", testing::obj_text(open));
  EXPECT_EQ(
      report(R"({ type = "mesh", file = "../open.obj" })"),
      "decks/deck.toml:16:32: body.stone.shape.file = \"open.obj\": is not closed: 3 edges have "
      "a triangle on one side only, the first from (1, 0, 0) to (1, 0, 1) m; close the holes, "
      "or give an open sheet a thickness with extrude\n");
  EXPECT_EQ(
      report(R"({ type = "mesh", file = "none.stl" })"),
      "decks/deck.toml:16:32: body.stone.shape.file = \"decks/none.stl\": cannot be read: "
      "decks/none.stl: No such file or directory; relative paths start at the deck's folder\n");
}

TEST_F(DeckGeometry, WrongKeysAreReported) {
  write("stone.stl", testing::ascii_stl(testing::box_mesh({0, 0, 0}, {1, 1, 1}), "top"));
  EXPECT_EQ(
      report(R"({ type = "mesh", file = "../stone.stl", region = "to" })"),
      "decks/deck.toml:16:57: body.stone.shape.region = \"to\": is not in the file, which has "
      "top; did you mean \"top\"?\n");
  EXPECT_EQ(
      report(R"({ type = "mesh", file = "../stone.stl", scale = 0 })"),
      "decks/deck.toml:16:56: body.stone.shape.scale = 0: must be above 0; allowed: above 0\n");
  EXPECT_NE(report(R"({ type = "mesh", file = "../stone.stl", base = 0 })")
                .find("shape.base = 0: does not belong to type = \"mesh\""),
            std::string::npos);
}

}  // namespace
}  // namespace scree
