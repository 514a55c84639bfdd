// SPDX-License-Identifier: Apache-2.0
#include "postproc/plot/heat_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "postproc/plot/canvas.hpp"
#include "postproc/plot/svg_drawing.hpp"

namespace scree {
namespace {

constexpr Colour ink{0.13, 0.13, 0.13};
constexpr int page_width = 1600;
constexpr double left = 150, right = 260, bottom = 110, top = 130;

/// The plotted rectangle: as wide as the page allows, or less where the map is tall.
Frame plot_frame(const HeatMap& map) {
  const double ratio = (map.y_high - map.y_low) / (map.x_high - map.x_low);
  const double room = page_width - left - right;
  const double width = std::min(room, 1100 / ratio);
  const double start = left + 0.5 * (room - width);
  return {start, bottom, start + width, bottom + width * ratio};
}

void box(Drawing& page, const Frame& f) {
  const Frame all{0, 0, page.width() - 1.0, page.height() - 1.0};
  page.line({{f.left, f.bottom},
             {f.right, f.bottom},
             {f.right, f.top},
             {f.left, f.top},
             {f.left, f.bottom}},
            all, ink, 1.8);
}

void draw_axes(Drawing& page, const HeatMap& map, const Frame& f) {
  const Frame all{0, 0, page.width() - 1.0, page.height() - 1.0};
  const double per_x = (f.right - f.left) / (map.x_high - map.x_low);
  const double per_y = (f.top - f.bottom) / (map.y_high - map.y_low);
  for (const double v :
       round_numbers(map.x_low, map.x_high, std::max(2.0, (f.right - f.left) / 140))) {
    const double x = f.left + (v - map.x_low) * per_x;
    page.line({{x, f.bottom}, {x, f.bottom - 8}}, all, ink, 1.8);
    page.text({x, f.bottom - 14}, tick_label(v), 22, Anchor::middle, Anchor::high);
  }
  for (const double v :
       round_numbers(map.y_low, map.y_high, std::max(2.0, (f.top - f.bottom) / 80))) {
    const double y = f.bottom + (v - map.y_low) * per_y;
    page.line({{f.left, y}, {f.left - 8, y}}, all, ink, 1.8);
    page.text({f.left - 14, y}, tick_label(v), 22, Anchor::high, Anchor::middle);
  }
  page.text({0.5 * (f.left + f.right), f.bottom - 50}, map.x_label, 24, Anchor::middle,
            Anchor::high);
  page.text({f.left - 100, 0.5 * (f.bottom + f.top)}, map.y_label, 24, Anchor::middle,
            Anchor::middle, false, true);
}

void draw_bar(Drawing& page, const HeatMap& map, const Frame& f, double low, double high) {
  const Frame all{0, 0, page.width() - 1.0, page.height() - 1.0};
  const double middle = 0.5 * (f.bottom + f.top);
  const double half = std::clamp(0.5 * (f.top - f.bottom) - 30, 90.0, 260.0);
  const Frame bar{page_width - 220.0, middle - half, page_width - 186.0, middle + half};
  constexpr int steps = 128;
  for (int i = 0; i < steps; ++i) {
    const double y0 = bar.bottom + 2 * half * i / steps,
                 y1 = bar.bottom + 2 * half * (i + 1) / steps;
    page.fill({bar.left, y0, bar.right, y1}, viridis((i + 0.5) / steps));
  }
  box(page, bar);
  for (const double v : round_numbers(low, high, 5)) {
    const double y = bar.bottom + 2 * half * (v - low) / (high - low);
    page.line({{bar.right, y}, {bar.right + 7, y}}, all, ink, 1.5);
    page.text({bar.right + 13, y}, tick_label(v), 22, Anchor::low, Anchor::middle);
  }
  page.text({bar.left - 20, bar.top + 16}, map.value_label, 22);
}

void draw(Drawing& page, const HeatMap& map, const Frame& f) {
  double low = map.low, high = map.high;
  if (!(high > low)) {
    low = std::numeric_limits<double>::max();
    high = std::numeric_limits<double>::lowest();
    for (const double v : map.values) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
    if (!(high > low)) {
      const double room = high == low && high != 0 ? 0.1 * std::abs(high) : 1;
      low = (high == low ? low : 0) - room;
      high = low + 2 * room;
    }
  }
  const double wide = (f.right - f.left) / static_cast<double>(map.columns);
  const double tall = (f.top - f.bottom) / static_cast<double>(map.rows);
  for (std::size_t j = 0; j < map.rows; ++j) {
    for (std::size_t i = 0; i < map.columns; ++i) {
      const double v = map.values[j * map.columns + i];
      if (!std::isfinite(v)) continue;
      const double x = f.left + wide * static_cast<double>(i);
      const double y = f.bottom + tall * static_cast<double>(j);
      page.fill({x, y, x + wide, y + tall}, viridis((v - low) / (high - low)));
    }
  }
  box(page, f);
  draw_axes(page, map, f);
  draw_bar(page, map, f, low, high);
  page.text({60, page.height() - 24.0}, map.title, 34, Anchor::low, Anchor::high, true);
  page.text({60, page.height() - 70.0}, map.subtitle, 24, Anchor::low, Anchor::high);
}

}  // namespace

Colour viridis(double share) {
  // Eleven points of the map (public domain) at even distances.
  static constexpr std::array<Colour, 11> points = {{{0.267, 0.005, 0.329},
                                                     {0.283, 0.141, 0.458},
                                                     {0.254, 0.265, 0.530},
                                                     {0.207, 0.372, 0.553},
                                                     {0.164, 0.471, 0.558},
                                                     {0.128, 0.567, 0.551},
                                                     {0.135, 0.659, 0.518},
                                                     {0.267, 0.749, 0.441},
                                                     {0.478, 0.821, 0.318},
                                                     {0.741, 0.873, 0.150},
                                                     {0.993, 0.906, 0.144}}};
  const double at = 10 * std::clamp(share, 0.0, 1.0);
  const auto i = std::min<std::size_t>(9, static_cast<std::size_t>(at));
  const double f = at - static_cast<double>(i);
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) colour[c] = (1 - f) * points[i][c] + f * points[i + 1][c];
  return colour;
}

void write_heat_map(const std::string& path, const std::string& mark, const HeatMap& map) {
  const Frame frame = plot_frame(map);
  const int height = static_cast<int>(std::max(frame.top, bottom + 240) + top);
  if (path.ends_with(".svg")) {
    SvgDrawing page(page_width, height);
    draw(page, map, frame);
    page.write(path, mark);
  } else {
    Canvas page(page_width, height);
    draw(page, map, frame);
    page.write_png(path, mark);
  }
}

std::vector<double> round_numbers(double low, double high, double most) {
  const double rough = (high - low) / most;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough * (1 - 1e-9)) step = factor * power;
  }
  std::vector<double> values;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    values.push_back(i == 0 ? 0.0 : i * step);
  }
  return values;
}

std::string tick_label(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace scree
