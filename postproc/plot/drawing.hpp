// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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

/// What charts are drawn on, in pixels from the lower left corner: a picture in memory or a text of
/// vector graphics.
class Drawing {
 public:
  virtual ~Drawing() = default;

  virtual int width() const = 0;
  virtual int height() const = 0;

  /// A line through the points, cut off at the frame; `dash` is the length of dashes and gaps, 0
  /// for none.
  virtual void line(const std::vector<Pixel>& points, const Frame& frame, Colour colour,
                    double thickness, double dash = 0) = 0;
  /// A filled disk.
  virtual void dot(Pixel centre, double radius, Colour colour) = 0;
  /// A filled rectangle.
  virtual void fill(const Frame& frame, Colour colour) = 0;
  /// A line of text of this height in pixels; the anchors say which part of it lies at the place
  /// (along and across the writing). Upward text is turned by 90 degrees. Returns its length in
  /// pixels.
  virtual int text(Pixel at, const std::string& words, double size, Anchor along = Anchor::low,
                   Anchor across = Anchor::low, bool bold = false, bool upward = false) = 0;
};

}  // namespace scree
