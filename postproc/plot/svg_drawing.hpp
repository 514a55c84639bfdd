// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "postproc/plot/drawing.hpp"

namespace scree {

/// A white drawing of vectors, an <svg> element in a page or a file: text stays text, lines stay
/// sharp at any size.
class SvgDrawing : public Drawing {
 public:
  SvgDrawing(int width, int height) : width_(width), height_(height) {}

  int width() const override { return width_; }
  int height() const override { return height_; }

  void line(const std::vector<Pixel>& points, const Frame& frame, Colour colour, double thickness,
            double dash = 0) override;
  void dot(Pixel centre, double radius, Colour colour) override;
  void fill(const Frame& frame, Colour colour) override;
  int text(Pixel at, const std::string& words, double size, Anchor along = Anchor::low,
           Anchor across = Anchor::low, bool bold = false, bool upward = false) override;

  /// The element, with `description` for those who cannot see it. It has no ids: many may stand in
  /// one page.
  std::string svg(const std::string& description) const;
  /// Writes a file with `mark` as a comment. Throws RunFault with one sentence.
  void write(const std::string& path, const std::string& mark) const;

 private:
  int width_, height_;
  std::string body_;
};

/// Text as it stands in XML and HTML, where < > & and " have a meaning.
std::string xml_text(const std::string& text);

}  // namespace scree
