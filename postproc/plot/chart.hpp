// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postproc/plot/canvas.hpp"

namespace scree {

/// A line in a chart.
struct Curve {
  std::vector<double> x, y;
  Colour colour{0.0, 0.33, 0.65};
  double thickness = 3;  ///< in pixels of a page 1600 wide
  bool dashed = false;
  bool start = false;  ///< a dot at the first point
  bool dots = false;   ///< a dot at every point
  bool line = true;    ///< a line through the points
  bool frames = true;  ///< counts when the axes' ranges are chosen
  std::string name;    ///< in the legend; empty: not there
};

/// A diagram with two axes.
struct Chart {
  std::string x_label, y_label;
  bool logarithmic_x = false;  ///< only with positive x
  bool logarithmic_y = false;  ///< points that are not positive are left out
  std::vector<Curve> curves;
};

/// Draws a chart, axes and labels included, into a frame of the drawing. The legend stands above
/// the axes, in as many lines as it takes, where it covers no curve.
/// `scale` is how many pixels stand for one of a page 1600 wide; 0: the drawing is such a page.
void draw_chart(Drawing& canvas, const Frame& frame, const Chart& chart, double scale = 0);

/// Height of the legend of a chart of this width, both in pixels of a page 1600 wide.
double legend_room(const Chart& chart, double width);

/// A page with a title over charts, two a row; one alone takes the whole width.
Canvas draw_page(const std::string& title, const std::string& subtitle,
                 const std::vector<Chart>& charts);

/// The same as a file: SVG where the name ends in .svg, else PNG. `mark` names the program in the
/// file. Throws RunFault.
void write_page(const std::string& path, const std::string& mark, const std::string& title,
                const std::string& subtitle, const std::vector<Chart>& charts);

}  // namespace scree
