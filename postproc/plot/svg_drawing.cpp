// SPDX-License-Identifier: Apache-2.0
#include "postproc/plot/svg_drawing.hpp"

#include <fmt/format.h>
#include <vtkFreeTypeTools.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <cmath>

#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

std::string escaped(const std::string& words) {
  std::string result;
  for (const char c : words) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string hex(const Colour& colour) {
  const auto part = [](double x) { return static_cast<int>(std::lround(255 * x)); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(colour[0]), part(colour[1]), part(colour[2]));
}

/// The length that the canvas would give the text; viewers have fonts of nearly the same widths.
int text_length(const std::string& words, double size, bool bold) {
  vtkNew<vtkTextProperty> style;
  style->SetFontFamilyToArial();
  style->SetFontSize(static_cast<int>(std::lround(size)));
  style->SetBold(bold);
  int box[4] = {0, 0, 0, 0};
  if (!vtkFreeTypeTools::GetInstance()->GetBoundingBox(style, vtkStdString(words), 72, box))
    return 0;
  return box[1] - box[0] + 1;
}

}  // namespace

SvgDrawing::SvgDrawing(int width, int height) : width_(width), height_(height) {}

void SvgDrawing::line(const std::vector<Pixel>& points, const Frame& frame, Colour colour,
                      double thickness, double dash) {
  if (points.empty()) return;
  const int id = ++frames_;
  body_ += fmt::format(
      "<clipPath id=\"f{}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>"
      "</clipPath>\n<polyline clip-path=\"url(#f{})\" fill=\"none\" stroke=\"{}\" "
      "stroke-width=\"{:.2f}\" stroke-linejoin=\"round\" stroke-linecap=\"{}\"",
      id, frame.left, height_ - frame.top, frame.right - frame.left, frame.top - frame.bottom, id,
      hex(colour), thickness, dash > 0 ? "butt" : "round");
  if (dash > 0) body_ += fmt::format(" stroke-dasharray=\"{:.1f}\"", dash);
  body_ += " points=\"";
  for (const Pixel& p : points) body_ += fmt::format("{:.2f},{:.2f} ", p.x, height_ - p.y);
  body_ += "\"/>\n";
}

void SvgDrawing::dot(Pixel centre, double radius, Colour colour) {
  body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n", centre.x,
                       height_ - centre.y, radius, hex(colour));
}

void SvgDrawing::fill(const Frame& frame, Colour colour) {
  body_ += fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
      "shape-rendering=\"crispEdges\"/>\n",
      frame.left, height_ - frame.top, frame.right - frame.left, frame.top - frame.bottom,
      hex(colour));
}

int SvgDrawing::text(Pixel at, const std::string& words, double size, Anchor along, Anchor across,
                     bool bold, bool upward) {
  const char* const anchors[] = {"start", "middle", "end"};
  // From the base line: capital letters are about 0.72 of the size high.
  const double drop = across == Anchor::low ? 0 : across == Anchor::middle ? 0.36 : 0.74;
  const double x = at.x, y = height_ - at.y;
  const std::string turn =
      upward ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y) : "";
  body_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-family=\"Arial, Helvetica, sans-serif\" "
      "font-size=\"{:.1f}\" fill=\"#212121\" text-anchor=\"{}\"{}{}>{}</text>\n",
      x, y + drop * size, size, anchors[static_cast<int>(along)],
      bold ? " font-weight=\"bold\"" : "", turn, escaped(words));
  return text_length(words, size, bold);
}

void SvgDrawing::write(const std::string& path, const std::string& mark) const {
  replace_file(path,
               fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {} -->\n"
                           "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" "
                           "viewBox=\"0 0 {} {}\">\n<rect width=\"100%\" height=\"100%\" "
                           "fill=\"white\"/>\n{}</svg>\n",
                           mark, width_, height_, width_, height_, body_));
}

}  // namespace scree
