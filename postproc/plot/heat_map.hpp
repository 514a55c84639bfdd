// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postproc/plot/drawing.hpp"

namespace scree {

/// A colour of the map viridis; `share` from 0 (dark) to 1 (light), clamped.
Colour viridis(double share);

/// Values in equal rectangles: value i + j * columns lies in column i (from the left), row j (from
/// below). Values that are not finite leave the paper white.
struct HeatMap {
  std::string title, subtitle, x_label, y_label, value_label;
  double x_low = 0, x_high = 1, y_low = 0, y_high = 1;  ///< edges
  std::size_t columns = 0, rows = 0;
  std::vector<double> values;
  double low = 0, high = 0;  ///< of the colours; equal: those of the values
};

/// Draws it, both axes at one scale, with a colour bar, into SVG where the name ends in .svg, else
/// PNG. Throws RunFault.
void write_heat_map(const std::string& path, const std::string& mark, const HeatMap& map);

/// Round numbers in a range, at most about `most` of them.
std::vector<double> round_numbers(double low, double high, double most);

/// A value at an axis, six digits at most.
std::string tick_label(double value);

}  // namespace scree
