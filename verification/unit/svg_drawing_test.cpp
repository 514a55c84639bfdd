// SPDX-License-Identifier: Apache-2.0
// Vector pictures: what is drawn, what is cut off, and that any text is safe in them.
#include "postproc/plot/svg_drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "postproc/plot/chart.hpp"

namespace scree {
namespace {

constexpr Frame frame{10, 10, 90, 90};

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(SvgDrawing, LinesAreCutOffAtTheFrame) {
  SvgDrawing drawing(100, 100);
  drawing.line({{0, 50}, {50, 50}, {200, 50}}, frame, {1, 0, 0}, 2);
  drawing.line({{0, 95}, {100, 95}}, frame, {1, 0, 0}, 2);  // above it
  const std::string svg = drawing.svg("a line");
  EXPECT_NE(svg.find("M10 50L50 50L90 50"), std::string::npos) << svg;
  EXPECT_EQ(count(svg, "<path"), 1);
}

TEST(SvgDrawing, RowsCountFromTheTop) {
  SvgDrawing drawing(100, 80);
  drawing.dot({20, 70}, 3, {0, 0, 1});
  EXPECT_NE(drawing.svg("").find("cx=\"20\" cy=\"10\" r=\"3\" fill=\"#0000ff\""),
            std::string::npos);
}

TEST(SvgDrawing, TextIsEscaped) {
  SvgDrawing drawing(100, 100);
  drawing.text({0, 0}, "a < b & \"c\"", 10);
  EXPECT_NE(drawing.svg("").find(">a &lt; b &amp; &quot;c&quot;</text>"), std::string::npos);
}

TEST(SvgDrawing, NumbersThatAreNoneAreLeftOut) {
  SvgDrawing drawing(100, 100);
  drawing.line({{20, 20}, {std::nan(""), 3}, {40, 20}}, frame, {0, 0, 0}, 1);
  drawing.dot({std::nan(""), 0}, 1, {0, 0, 0});
  EXPECT_EQ(drawing.svg("").find("nan"), std::string::npos);
}

TEST(SvgDrawing, AChartWithTwoLogarithmicAxes) {
  Chart chart;
  chart.logarithmic_x = chart.logarithmic_y = true;
  Curve curve;
  curve.x = {0.01, 0.1, 1};
  curve.y = {1e-6, 1e-4, 1e-2};
  curve.dots = true;
  curve.name = "second order";
  chart.curves = {curve};
  SvgDrawing drawing(780, 520);
  draw_chart(drawing, {0, 0, 780, 520}, chart, 1);
  const std::string svg = drawing.svg("a chart");
  EXPECT_NE(svg.find(">0.0001</text>"), std::string::npos);
  EXPECT_NE(svg.find(">second order</text>"), std::string::npos);
  EXPECT_EQ(count(svg, "<circle"), 4) << "three points and one in the legend";
}

}  // namespace
}  // namespace scree
