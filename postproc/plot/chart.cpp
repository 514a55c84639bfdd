// SPDX-License-Identifier: Apache-2.0
#include "postproc/plot/chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "postproc/plot/svg_drawing.hpp"

namespace scree {
namespace {

constexpr Colour ink{0.13, 0.13, 0.13}, pale{0.88, 0.88, 0.88};
constexpr double text_size = 22;

/// One axis: its range, and where a value stands between 0 and 1.
struct Axis {
  double low = 0, high = 1;
  bool logarithmic = false;

  double share(double value) const {
    if (!logarithmic) return (value - low) / (high - low);
    return std::log(value / low) / std::log(high / low);
  }
};

/// Distance of round numbers, at most about `most` in the range.
double tick_step(double low, double high, double most) {
  const double rough = (high - low) / most;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::vector<double> even_ticks(const Axis& axis, double most) {
  std::vector<double> values;
  const double step = tick_step(axis.low, axis.high, most);
  for (double i = std::ceil(axis.low / step - 1e-9); i * step <= axis.high + 1e-9 * step; ++i) {
    values.push_back(i == 0 ? 0.0 : i * step);
  }
  return values;
}

/// 1, 2 and 5 of each decade, or powers of ten alone over more than three; over less than a decade,
/// where these are few, round numbers of equal distance, as many as their labels leave room for.
std::vector<double> logarithmic_ticks(const Axis& axis) {
  std::vector<double> values;
  const double decades = std::log10(axis.high / axis.low);
  const auto every = std::max(1, static_cast<int>(std::ceil(decades / 8)));
  for (int exponent = static_cast<int>(std::floor(std::log10(axis.low)));
       std::pow(10.0, exponent) <= axis.high; exponent += decades > 3 ? every : 1) {
    const double power = std::pow(10.0, exponent);
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (decades > 3 && factor > 1) continue;
      const double value = factor * power;
      if (value >= axis.low * (1 - 1e-9) && value <= axis.high * (1 + 1e-9)) {
        values.push_back(value);
      }
    }
  }
  if (values.size() > 3 || decades > 2) return values;
  constexpr double room = 0.09;
  values.clear();
  for (const double value : even_ticks(axis, 8)) {
    if (values.empty() || axis.share(value) - axis.share(values.back()) > room) {
      values.push_back(value);
    }
  }
  return values;
}

std::vector<double> ticks(const Axis& axis, double most) {
  return axis.logarithmic ? logarithmic_ticks(axis) : even_ticks(axis, most);
}

/// "20", "0.02", and below a thousandth "5e-4": short, for the axis' own label stands beside it.
std::string tick_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value != 0 && std::abs(value) < 1e-3 ? "%.2e" : "%.6g", value);
  std::string result = text;
  const std::size_t e = result.find('e');
  if (e == std::string::npos) return result;
  std::string digits = result.substr(0, e), power = result.substr(e + 1);
  if (digits.find('.') != std::string::npos) {
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  const bool negative = power[0] == '-';
  power.erase(0, std::min(power.find_first_not_of("+-0"), power.size() - 1));
  return digits + (negative ? "e-" : "e") + power;
}

/// The range of the curves, widened to whole ticks; a constant gets room around it.
Axis choose_axis(const Chart& chart, std::vector<double> Curve::*values, bool logarithmic,
                 double most) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Curve& curve : chart.curves) {
    if (!curve.frames) continue;
    for (const double value : curve.*values) {
      if (!std::isfinite(value) || (logarithmic && !(value > 0))) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high) return {logarithmic ? 0.1 : 0.0, 1, logarithmic};
  if (logarithmic) return {low / 1.1, high * 1.1, true};
  // What is flat to four digits is shown as flat: labels have few digits.
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(high - low > 1e-4 * size)) {
    const double room = size > 0 ? 0.1 * size : 1;
    low -= room;
    high += room;
  }
  // Again, as the wider range may have another step: the ends carry labels.
  for (int i = 0; i < 2; ++i) {
    const double step = tick_step(low, high, most);
    low = step * std::floor(low / step + 1e-9);
    high = step * std::ceil(high / step - 1e-9);
  }
  return {low, high, false};
}

constexpr double legend_height = 34;

/// About how long an entry of the legend is, in pixels of the design: letters are half as wide as
/// high.
double entry_length(const Curve& curve) {
  return 84 + 0.47 * text_size * static_cast<double>(curve.name.size());
}

/// Lines of the legend over axes of this length.
int legend_lines(const Chart& chart, double length) {
  int lines = 0;
  double used = length;
  for (const Curve& curve : chart.curves) {
    if (curve.name.empty()) continue;
    const double more = entry_length(curve);
    if (lines == 0 || used + more > length) {
      ++lines;
      used = 0;
    }
    used += more;
  }
  return lines;
}

constexpr double left_room = 136, right_room = 30;  ///< beside the axes, for labels

/// Draws in the plotted area of one chart.
class ChartPainter {
 public:
  ChartPainter(Drawing& canvas, const Frame& frame, const Chart& chart, double scale)
      : canvas_(canvas),
        chart_(chart),
        scale_(scale > 0 ? scale : canvas.width() / 1600.0),
        legend_lines_(
            legend_lines(chart, (frame.right - frame.left) / scale_ - left_room - right_room)),
        area_{frame.left + left_room * scale_, frame.bottom + 80 * scale_,
              frame.right - right_room * scale_,
              frame.top - (20 + legend_lines_ * legend_height) * scale_},
        x_(choose_axis(chart, &Curve::x, chart.logarithmic_x, 6)),
        y_(choose_axis(chart, &Curve::y, chart.logarithmic_y, 6)) {}

  void draw() {
    draw_axes();
    for (const Curve& curve : chart_.curves) draw_curve(curve);
    draw_legend();
  }

 private:
  Pixel place(double x, double y) const {
    return {area_.left + (area_.right - area_.left) * x_.share(x),
            area_.bottom + (area_.top - area_.bottom) * y_.share(y)};
  }

  void rule(Pixel a, Pixel b, Colour colour, double thickness) {
    const Frame all{0, 0, canvas_.width() - 1.0, canvas_.height() - 1.0};
    canvas_.line({a, b}, all, colour, thickness * scale_);
  }

  void draw_axes() {
    const double s = scale_;
    for (const double value : ticks(x_, 6)) {
      const double x = place(value, y_.low).x;
      rule({x, area_.bottom}, {x, area_.top}, pale, 1.2);
      canvas_.text({x, area_.bottom - 10 * s}, tick_text(value), text_size * s, Anchor::middle,
                   Anchor::high);
    }
    for (const double value : ticks(y_, 6)) {
      const double y = place(x_.low, value).y;
      rule({area_.left, y}, {area_.right, y}, pale, 1.2);
      canvas_.text({area_.left - 10 * s, y}, tick_text(value), text_size * s, Anchor::high,
                   Anchor::middle);
    }
    const Pixel corners[5] = {{area_.left, area_.bottom},
                              {area_.right, area_.bottom},
                              {area_.right, area_.top},
                              {area_.left, area_.top},
                              {area_.left, area_.bottom}};
    for (int i = 0; i < 4; ++i) rule(corners[i], corners[i + 1], ink, 1.8);
    canvas_.text({0.5 * (area_.left + area_.right), area_.bottom - 44 * s}, chart_.x_label,
                 (text_size + 2) * s, Anchor::middle, Anchor::high);
    canvas_.text({area_.left - 100 * s, 0.5 * (area_.bottom + area_.top)}, chart_.y_label,
                 (text_size + 2) * s, Anchor::middle, Anchor::high, false, true);
  }

  void draw_curve(const Curve& curve) {
    std::vector<Pixel> points;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (x_.logarithmic && !(curve.x[i] > 0)) continue;
      if (y_.logarithmic && !(curve.y[i] > 0)) continue;
      points.push_back(place(curve.x[i], curve.y[i]));
    }
    if (points.empty()) return;
    if (curve.line) {
      canvas_.line(points, area_, curve.colour, curve.thickness * scale_,
                   curve.dashed ? 11 * scale_ : 0);
    }
    if (curve.start) canvas_.dot(points.front(), 7 * scale_, curve.colour);
    if (!curve.dots) return;
    for (const Pixel& p : points) {
      const bool inside = p.x >= area_.left - 1 && p.x <= area_.right + 1 &&
                          p.y >= area_.bottom - 1 && p.y <= area_.top + 1;
      if (inside) canvas_.dot(p, 5 * scale_, curve.colour);
    }
  }

  /// The sign of a curve in the legend.
  void draw_sign(const Curve& curve, double x, double y) {
    const double s = scale_;
    const Frame all{0, 0, canvas_.width() - 1.0, canvas_.height() - 1.0};
    if (curve.line) {
      canvas_.line({{x, y}, {x + 44 * s, y}}, all, curve.colour, curve.thickness * s,
                   curve.dashed ? 11 * s : 0);
    }
    if (curve.dots) canvas_.dot({x + 22 * s, y}, 5 * s, curve.colour);
  }

  void draw_legend() {
    const double s = scale_;
    double y = area_.top + (legend_lines_ - 0.4) * legend_height * s;
    double x = area_.left, used = 0;
    for (const Curve& curve : chart_.curves) {
      if (curve.name.empty()) continue;
      const double more = entry_length(curve);
      if (used > 0 && used + more > (area_.right - area_.left) / s) {
        y -= legend_height * s;
        x = area_.left;
        used = 0;
      }
      used += more;
      draw_sign(curve, x, y);
      x += 54 * s;
      x += canvas_.text({x, y}, curve.name, text_size * s, Anchor::low, Anchor::middle) + 30 * s;
    }
  }

  Drawing& canvas_;
  const Chart& chart_;
  double scale_;
  int legend_lines_;
  Frame area_;
  Axis x_, y_;
};

}  // namespace

double legend_room(const Chart& chart, double width) {
  return legend_height * legend_lines(chart, width - left_room - right_room);
}

void draw_chart(Drawing& canvas, const Frame& frame, const Chart& chart, double scale) {
  ChartPainter(canvas, frame, chart, scale).draw();
}

namespace {

constexpr int page_width = 1600, row_height = 560, head = 110;

int page_height(const std::vector<Chart>& charts) {
  return head + static_cast<int>((charts.size() + 1) / 2) * row_height + 20;
}

void fill_page(Drawing& canvas, const std::string& title, const std::string& subtitle,
               const std::vector<Chart>& charts) {
  // A single chart has the whole width.
  const double width = charts.size() == 1 ? 1560 : 780;
  const auto lines = [&](const Chart& chart) {
    return legend_lines(chart, width - left_room - right_room);
  };
  int most = 0;
  for (const Chart& chart : charts) most = std::max(most, lines(chart));
  const double top = canvas.height() - 24;
  canvas.text({60, top}, title, 34, Anchor::low, Anchor::high, true);
  canvas.text({60, top - 46}, subtitle, 24, Anchor::low, Anchor::high);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const double left = 20 + 780.0 * static_cast<double>(i % 2);
    const double upper = canvas.height() - head - row_height * static_cast<double>(i / 2);
    // Charts with a smaller legend leave the same room: axes of a row end at one height.
    const double room = legend_height * (most - lines(charts[i]));
    draw_chart(canvas, {left, upper - row_height + 10, left + width, upper - room}, charts[i]);
  }
}

}  // namespace

Canvas draw_page(const std::string& title, const std::string& subtitle,
                 const std::vector<Chart>& charts) {
  Canvas canvas(page_width, page_height(charts));
  fill_page(canvas, title, subtitle, charts);
  return canvas;
}

void write_page(const std::string& path, const std::string& mark, const std::string& title,
                const std::string& subtitle, const std::vector<Chart>& charts) {
  if (!path.ends_with(".svg")) {
    draw_page(title, subtitle, charts).write_png(path, mark);
    return;
  }
  SvgDrawing drawing(page_width, page_height(charts));
  fill_page(drawing, title, subtitle, charts);
  drawing.write(path, mark);
}

}  // namespace scree
