// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "postproc/plot/drawing.hpp"

namespace scree {

/// A white picture in memory with smooth lines and text. It needs no screen.
class Canvas : public Drawing {
 public:
  Canvas(int width, int height);

  int width() const override { return width_; }
  int height() const override { return height_; }

  void line(const std::vector<Pixel>& points, const Frame& frame, Colour colour, double thickness,
            double dash = 0) override;
  void dot(Pixel centre, double radius, Colour colour) override;
  void fill(const Frame& frame, Colour colour) override;
  int text(Pixel at, const std::string& words, double size, Anchor along = Anchor::low,
           Anchor across = Anchor::low, bool bold = false, bool upward = false) override;

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
