// SPDX-License-Identifier: Apache-2.0
#include "postproc/plot/svg_drawing.hpp"

#include <fmt/format.h>
#include <vtkFreeTypeTools.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

std::string hex(const Colour& colour) {
  const auto part = [&](std::size_t c) {
    return static_cast<int>(std::lround(255 * std::clamp(colour[c], 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

/// Half a tenth of a pixel cannot be seen.
std::string number(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

/// The part of a segment inside of the frame (Liang and Barsky 1984), or nothing.
std::optional<std::pair<Pixel, Pixel>> clipped(Pixel a, Pixel b, const Frame& frame) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double slope[4] = {-dx, dx, -dy, dy};
  const double room[4] = {a.x - frame.left, frame.right - a.x, a.y - frame.bottom, frame.top - a.y};
  double enter = 0, leave = 1;
  for (int side = 0; side < 4; ++side) {
    if (slope[side] == 0) {
      if (room[side] < 0) return std::nullopt;
      continue;
    }
    const double cut = room[side] / slope[side];
    if (slope[side] < 0) enter = std::max(enter, cut);
    if (slope[side] > 0) leave = std::min(leave, cut);
  }
  if (enter > leave) return std::nullopt;
  return std::make_pair(Pixel{a.x + enter * dx, a.y + enter * dy},
                        Pixel{a.x + leave * dx, a.y + leave * dy});
}

bool same(Pixel a, Pixel b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-9; }

/// The points as they can be told apart.
std::vector<Pixel> thinned(const std::vector<Pixel>& points) {
  std::vector<Pixel> kept;
  for (const Pixel& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    if (kept.empty() || std::hypot(p.x - kept.back().x, p.y - kept.back().y) > 0.3)
      kept.push_back(p);
  }
  return kept;
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

std::string xml_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

void SvgDrawing::line(const std::vector<Pixel>& points, const Frame& frame, Colour colour,
                      double thickness, double dash) {
  const std::vector<Pixel> kept = thinned(points);
  std::string path;
  Pixel pen;
  bool down = false;
  for (std::size_t i = 1; i < kept.size(); ++i) {
    const auto piece = clipped(kept[i - 1], kept[i], frame);
    if (!piece) continue;
    if (!down || !same(pen, piece->first))
      path += fmt::format("M{} {}", number(piece->first.x), number(height_ - piece->first.y));
    path += fmt::format("L{} {}", number(piece->second.x), number(height_ - piece->second.y));
    pen = piece->second;
    down = true;
  }
  if (path.empty()) return;
  const std::string dashes = dash > 0 ? fmt::format(" stroke-dasharray=\"{}\"", number(dash)) : "";
  body_ += fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
      "stroke-linejoin=\"round\"{}/>\n",
      path, hex(colour), number(thickness), dashes);
}

void SvgDrawing::dot(Pixel centre, double radius, Colour colour) {
  if (!std::isfinite(centre.x) || !std::isfinite(centre.y)) return;
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", number(centre.x),
                       number(height_ - centre.y), number(radius), hex(colour));
}

void SvgDrawing::fill(const Frame& frame, Colour colour) {
  body_ += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" "
      "shape-rendering=\"crispEdges\"/>\n",
      number(frame.left), number(height_ - frame.top), number(frame.right - frame.left),
      number(frame.top - frame.bottom), hex(colour));
}

int SvgDrawing::text(Pixel at, const std::string& words, double size, Anchor along, Anchor across,
                     bool bold, bool upward) {
  if (words.empty()) return 0;
  const char* const anchor = along == Anchor::low      ? "start"
                             : along == Anchor::middle ? "middle"
                                                       : "end";
  // From the base line: letters stand 0.72 of their size high.
  const double down = across == Anchor::low ? 0 : across == Anchor::middle ? 0.36 : 0.72;
  const double x = upward ? at.x + down * size : at.x;
  const double y = height_ - at.y + (upward ? 0 : down * size);
  const std::string turn =
      upward ? fmt::format(" transform=\"rotate(-90 {} {})\"", number(x), number(y)) : "";
  body_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\"{}{}>{}</text>\n", number(x),
      number(y), number(size), anchor, bold ? " font-weight=\"bold\"" : "", turn, xml_text(words));
  return text_length(words, size, bold);
}

std::string SvgDrawing::svg(const std::string& description) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" role=\"img\" "
      "aria-label=\"{2}\" font-family=\"Helvetica, Arial, sans-serif\" fill=\"#222\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "{3}</svg>\n",
      width_, height_, xml_text(description), body_);
}

void SvgDrawing::write(const std::string& path, const std::string& mark) const {
  replace_file(path, fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {} -->\n{}",
                                 mark, svg("")));
}

}  // namespace scree
