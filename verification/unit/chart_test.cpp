// SPDX-License-Identifier: Apache-2.0
// Pictures of charts: what a reader must be able to see.
#include "postproc/plot/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace scree {
namespace {

constexpr Colour white{1, 1, 1}, red{1, 0, 0};
constexpr int width = 780, height = 560;

/// A chart drawn alone on a page that fits it; a page of this width has a scale of 780/1600.
Canvas drawn(const Chart& chart) {
  Canvas canvas(width, height);
  draw_chart(canvas, {0, 0, width, height}, chart);
  return canvas;
}

Curve square(Colour colour, const std::string& name) {
  Curve curve;
  // Not at whole ticks, where the axes end.
  curve.x = {0.25, 0.75, 0.75, 0.25, 0.25};
  curve.y = {0.25, 0.25, 0.75, 0.75, 0.25};
  curve.colour = colour;
  curve.name = name;
  return curve;
}

int red_pixels(const Canvas& canvas) {
  int count = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) count += canvas.pixel(x, y) == red;
  }
  return count;
}

TEST(Chart, TheLegendLiesOutsideOfTheAxes) {
  Chart chart;
  chart.curves = {square(white, "first name"), square(white, "second name")};
  const Canvas canvas = drawn(chart);
  const auto dark = [&](int x, int y) { return canvas.pixel(x, y)[0] < 0.6; };
  // The upper edge of the axes: the highest row that is dark nearly all along.
  int top = height - 1;
  const auto edge = [&](int y) {
    int count = 0;
    for (int x = 0; x < width; ++x) count += dark(x, y);
    return count > width / 2;
  };
  while (top > 0 && !edge(top)) --top;
  ASSERT_GT(top, height / 2);
  int above = 0, inside = 0;
  for (int x = 80; x < width - 40; ++x) {
    for (int y = top + 4; y < height; ++y) above += dark(x, y);
    for (int y = height / 4; y < top - 4; ++y) inside += dark(x, y);
  }
  EXPECT_GT(above, 50);
  EXPECT_EQ(inside, 0);
}

TEST(Chart, CurvesAreDrawnInTheirColour) {
  Chart chart;
  chart.curves = {square(red, "")};
  EXPECT_GT(red_pixels(drawn(chart)), 1000);
}

TEST(Chart, TheEndsOfAnAxisCarryLabels) {
  // -72 to 217: whole ticks of 50 give -100 to 250, where ticks of 100 do, and these end at 300.
  Chart chart;
  chart.curves = {square(red, "")};
  for (double& y : chart.curves.front().y) y = y > 0.5 ? 217 : -72;
  const Canvas canvas = drawn(chart);
  int top = height - 1, lowest = height, highest = 0;
  for (; canvas.pixel(width / 2, top)[0] > 0.6; --top) {
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (canvas.pixel(x, y) != red) continue;
      lowest = std::min(lowest, y);
      highest = std::max(highest, y);
    }
  }
  const double scale = (highest - lowest) / (217 + 72.0);
  // The lines have a thickness of 1.5 pixels.
  EXPECT_NEAR(top - highest, (300 - 217) * scale, 3);
}

/// The number of vertical lines of the grid, left and right edge not counted.
int grid_lines(const Chart& chart) {
  const Canvas canvas = drawn(chart);
  // On a horizontal line of the grid a row is grey all along, one run; the others count.
  int most = 0;
  for (int y = height / 4; y < height / 2; ++y) {
    int lines = 0;
    bool before = false;
    for (int x = 70; x < width - 20; ++x) {
      const bool grey = canvas.pixel(x, y)[0] < 0.97 && canvas.pixel(x, y)[0] > 0.6;
      lines += grey && !before;
      before = grey;
    }
    most = std::max(most, lines);
  }
  return most;
}

TEST(Chart, ALogarithmicAxisOfLessThanADecadeHasTicksToRead) {
  for (const auto& [low, high] : {std::pair{100.0, 220.0}, {90.0, 700.0}, {31.0, 62.0}}) {
    Chart chart;
    chart.logarithmic_x = true;
    chart.curves = {square(white, "")};
    for (double& x : chart.curves.front().x) x = x > 0.5 ? high : low;
    EXPECT_GE(grid_lines(chart), 4) << low << " to " << high;
    EXPECT_LE(grid_lines(chart), 12) << low << " to " << high;
  }
}

}  // namespace
}  // namespace scree
