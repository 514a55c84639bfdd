// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace scree {

using Colour = std::array<double, 3>;  ///< red, green, blue, 0 to 1

/// A place on a canvas in pixels from its lower left corner.
struct Pixel {
  double x = 0, y = 0;
};

/// A rectangle of a canvas.
struct Frame {
  double left = 0, bottom = 0, right = 0, top = 0;
};

enum class Anchor { low, middle, high };

/// A white picture in memory with smooth lines and text. It needs no screen.
class Canvas {
 public:
  Canvas(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// A line through the points, cut off at the frame; `dash` is the length of dashes and gaps, 0
  /// for none.
  void line(const std::vector<Pixel>& points, const Frame& frame, Colour colour, double thickness,
            double dash = 0);
  /// A filled disk.
  void dot(Pixel centre, double radius, Colour colour);
  /// A line of text of this height in pixels; the anchors say which part of it lies at the place
  /// (along and across the writing). Upward text is turned by 90 degrees. Returns its length in
  /// pixels.
  int text(Pixel at, const std::string& words, double size, Anchor along = Anchor::low,
           Anchor across = Anchor::low, bool bold = false, bool upward = false);

  /// The colour of a pixel, columns from the left, rows from the bottom.
  Colour pixel(int x, int y) const;

  /// Writes a PNG with `mark` as its comment "Software". Throws RunFault with one sentence.
  void write_png(const std::string& path, const std::string& mark) const;

 private:
  void blend(int x, int y, const Colour& colour, double share);

  int width_, height_;
  std::vector<std::uint8_t> pixels_;  ///< rgb, rows from the bottom
};

}  // namespace scree
