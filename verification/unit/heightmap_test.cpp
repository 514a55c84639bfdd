// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "solver/particles/shape.hpp"
#include "solver/particles/shape_volume.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

/// Three by two cells of 2 m; heights of the plane 1 + x/4 + y/2 at the centres, y = 3 first.
const char* const plane =
    "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -99\n"
    "2.75 3.25 3.75\n1.75 2.25 2.75\n";

class Heightmap : public ::testing::Test {
 protected:
  ShapeSpec spec(const std::string& text, double base = 0) {
    write_text(folder_ / "map.asc", text);
    ShapeSpec s;
    s.kind = ShapeKind::heightmap;
    s.file = (folder_ / "map.asc").string();
    s.base = base;
    return s;
  }
  std::string problem(const ShapeSpec& s, int dimension = 3) {
    const auto found = find_problem(s, dimension);
    return found ? found->key + " " + found->message : "none";
  }
  TemporaryFolder folder_;
};

double distance(const Shape& shape, double x, double y, double z) {
  const double at[3] = {x, y, z};
  return shape.signed_distance(at);
}

TEST_F(Heightmap, IsBilinearBetweenCentresAndLevelBeyond) {
  const auto ground = make_shape(spec(plane), 3);
  const double shrink = 1 / std::sqrt(1 + 0.25 * 0.25 + 0.5 * 0.5);
  EXPECT_NEAR(distance(*ground, 2, 1.5, 4), (4 - 2.25) * shrink, 1e-15);
  EXPECT_NEAR(distance(*ground, 2, 1.5, 2.25), 0, 1e-15);
  EXPECT_NEAR(distance(*ground, 0.25, 0.25, 1.75), 0, 1e-15);  // as at (1, 1)
  EXPECT_NEAR(distance(*ground, 5.75, 3.75, 3.75), 0, 1e-15);  // as at (5, 3)
  EXPECT_NEAR(distance(*ground, 3, 2, 0.125), -0.125, 1e-15);  // the base is nearest
  EXPECT_NEAR(distance(*ground, 6.5, 2, 1), 0.5, 1e-15);
  const double x[3] = {2, 1.5, 1};
  double n[3];
  ground->normal(x, n);
  EXPECT_NEAR(n[0], -0.25 * shrink, 1e-15);
  EXPECT_NEAR(n[1], -0.5 * shrink, 1e-15);
  EXPECT_NEAR(n[2], shrink, 1e-15);
  const Box box = ground->bounds();
  EXPECT_EQ(box.lower, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(box.upper, (std::array<double, 3>{6, 4, 3.75}));
}

TEST_F(Heightmap, VolumeIsTheSumOfTheCells) {
  const double sum = 1.75 + 2.25 + 2.75 + 2.75 + 3.25 + 3.75;
  EXPECT_NEAR(*exact_volume(spec(plane, 0.5), 3), (sum - 6 * 0.5) * 4, 1e-13);
}

TEST_F(Heightmap, ScaleAndShiftActOnTheMap) {
  ShapeSpec s = spec(plane, 10.1);
  s.scale = 0.5;
  s.translate = {100, 200, 10};
  const auto ground = make_shape(s, 3);
  EXPECT_NEAR(distance(*ground, 101, 200.75, 10 + 2.25 / 2), 0, 1e-14);
  EXPECT_EQ(ground->bounds().upper[0], 103);
}

TEST_F(Heightmap, ASectionIsAProfile) {
  ShapeSpec s = spec(plane);
  s.section = {{1, 1}, {5, 3}};  // along (2, 1)/sqrt(5): slope (0.25*2 + 0.5)/sqrt(5)
  const auto ground = make_shape(s, 2);
  const double length = std::sqrt(20.0), slope = 1 / std::sqrt(5.0);
  const double shrink = 1 / std::sqrt(1 + slope * slope);
  EXPECT_NEAR(ground->bounds().upper[0], length, 1e-14);
  EXPECT_NEAR(ground->bounds().upper[1], 3.75, 1e-14);
  EXPECT_NEAR(distance(*ground, 2, 1.75 + 2 * slope, 0), 0, 1e-14);
  const double x[3] = {2, 1, 0};
  double n[3];
  ground->normal(x, n);
  EXPECT_NEAR(n[0], -slope * shrink, 1e-14);
  EXPECT_NEAR(n[1], shrink, 1e-14);
  EXPECT_NEAR(*exact_volume(s, 2), length * (1.75 + 3.75) / 2, 1e-13);
}

// z = x y is bilinear: along the diagonal of the square between the centres the profile is s^2/2.
TEST_F(Heightmap, AProfileAcrossASaddleIsAParabola) {
  ShapeSpec s = spec("ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n0 1\n0 0\n", -1);
  s.section = {{0, 0}, {1, 1}};
  const auto ground = make_shape(s, 2);
  EXPECT_NEAR(distance(*ground, 0.6, 0.18, 0), 0, 1e-15);
  EXPECT_NEAR(*exact_volume(s, 2), std::sqrt(2.0) * (1 + 1 / 3.), 1e-14);
}

TEST_F(Heightmap, ASingleRowIsAProfile) {
  const auto ground =
      make_shape(spec("ncols 3\nnrows 1\nxllcenter 1\nyllcorner 0\ncellsize 2\n1 2 1\n"), 2);
  EXPECT_NEAR(distance(*ground, 2, 1.5, 0), 0, 1e-15);
  EXPECT_NEAR(distance(*ground, 0.5, 1, 0), 0, 1e-15);
  EXPECT_EQ(ground->bounds().upper[0], 6);
  EXPECT_EQ(ground->bounds().upper[1], 2);
}

TEST_F(Heightmap, BrokenFilesAreExplained) {
  const std::string is = "file is no ESRI ASCII raster that can be read: line ";
  EXPECT_EQ(problem(spec("ncols 2\nnrows 1\ncellsize 1\nxllcorner 0\n1 2\n")),
            is + "5: the header has no yllcorner");
  EXPECT_EQ(problem(spec("ncols 2\nnrow 1\n")), is + "2: unknown key \"nrow\" in the header");
  const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  EXPECT_EQ(problem(spec(head + "1 2\n3\n")), is + "8: the heights end before row 2, column 2");
  EXPECT_EQ(problem(spec(head + "1 2\n3 4\n5\n")),
            is + "8: \"5\" stands after the last of 2 x 2 heights");
  EXPECT_EQ(problem(spec(head + "1 2\n3 four\n")),
            is + "7: \"four\" is no height (row 2, column 2)");
  EXPECT_EQ(problem(spec("ncols 2.5\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n")),
            is + "6: ncols must be a whole number above 0");
}

TEST_F(Heightmap, CellsWithoutDataNeedAHeight) {
  ShapeSpec s = spec("ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n3 -9999\n");
  EXPECT_EQ(
      problem(s).rfind("file has a cell without data, the first at (1.5, 0.5) of the map;", 0), 0u)
      << problem(s);
  s.no_data = 1.0;
  EXPECT_NEAR(*exact_volume(s, 3), 3 + 1, 1e-15);
}

TEST_F(Heightmap, BaseAndSectionAreChecked) {
  EXPECT_EQ(problem(spec(plane, 1.75)),
            "base must lie below the surface, which comes down to 1.75 m at (1, 1)");
  EXPECT_EQ(problem(spec(plane), 2).rfind("section is needed where a raster has 2 rows;", 0), 0u);
  ShapeSpec s = spec(plane);
  s.section = {{0, 0}, {7, 1}};
  EXPECT_EQ(problem(s, 2), "section leaves the raster, which reaches from (0, 0) to (6, 4)");
  s.section = {{1, 1}};
  EXPECT_EQ(problem(s, 2), "section must be two points, the ends of a straight line");
}

}  // namespace
}  // namespace scree
