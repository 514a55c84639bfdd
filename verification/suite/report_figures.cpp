// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/report_figures.hpp"

#include <algorithm>
#include <cmath>

#include "postproc/plot/chart.hpp"
#include "postproc/plot/svg_drawing.hpp"

namespace scree::verify {
namespace {

constexpr int width = 780, axes_height = 450;
constexpr Colour black{0.1, 0.1, 0.1};

/// Colours that can be told apart also by most of the colour-blind (Okabe and Ito), and more for
/// cases with many series.
Colour colour_of(std::size_t series) {
  static const Colour colours[] = {{0.0, 0.447, 0.698}, {0.835, 0.369, 0.0}, {0.0, 0.62, 0.451},
                                   {0.8, 0.475, 0.655}, {0.902, 0.624, 0.0}, {0.337, 0.706, 0.914},
                                   {0.45, 0.35, 0.2},   {0.36, 0.2, 0.6},    {0.6, 0.05, 0.15},
                                   {0.55, 0.6, 0.1},    {0.0, 0.35, 0.35},   {0.95, 0.5, 0.55}};
  return colours[series % std::size(colours)];
}

Picture drawn(const std::string& title, const Chart& chart) {
  const int height = axes_height + static_cast<int>(legend_room(chart, width));
  SvgDrawing drawing(width, height);
  draw_chart(drawing, {0, 0, double(width), double(height)}, chart, 1);
  return {title, drawing.svg(title)};
}

/// A run whose figures are drawn.
struct Shown {
  const RunResult* run = nullptr;
  std::string name;        ///< of its curves
  std::size_t colour = 0;  ///< a series has one, more runs of it have others
};

/// The finest run of each series that came to its end. Where an angle or a load is swept and no
/// size, all runs: they are different problems.
std::vector<Shown> shown_runs(const CaseResult& result) {
  std::vector<Shown> shown;
  std::size_t more = result.sweep.series.size();
  for (std::size_t s = 0; s < result.sweep.series.size(); ++s) {
    std::vector<const RunResult*> runs;
    for (const RunResult& run : result.runs) {
      if (run.plan.series == s && run.fault.empty()) runs.push_back(&run);
    }
    if (runs.empty()) continue;
    const auto size = [](const RunResult* a, const RunResult* b) {
      return a->plan.size < b->plan.size;
    };
    const auto [least, most] = std::minmax_element(runs.begin(), runs.end(), size);
    if (runs.size() == 1 || (*most)->plan.size > 1.001 * (*least)->plan.size) {
      shown.push_back({*least, (*least)->plan.series_name, s});
      continue;
    }
    for (const RunResult* run : runs)
      shown.push_back({run, run->plan.label, run == runs.front() ? s : more++});
  }
  return shown;
}

Curve curve_of(const FigureCurve& source, std::size_t colour, const std::string& name) {
  Curve curve;
  curve.x = source.x;
  curve.y = source.y;
  curve.dots = source.dots;
  curve.line = !source.dots;
  curve.colour = source.reference ? black : colour_of(colour);
  curve.dashed = source.reference;
  curve.thickness = source.reference ? 2.5 : 3;
  curve.name = name;
  return curve;
}

std::string joined(const std::string& series, const std::string& name, bool one_series) {
  if (one_series) return name.empty() ? series : name;
  return name.empty() ? series : series + ": " + name;
}

class FigureCollector {
 public:
  explicit FigureCollector(const CaseResult& result) : result_(result) {}

  std::vector<Picture> all() {
    const auto runs = shown_runs(result_);
    for (const Shown& shown : runs) collect(shown.run->measured, shown, runs.size() == 1);
    collect(result_.compared, {}, true);
    std::vector<Picture> pictures;
    for (std::size_t i = 0; i < charts_.size(); ++i)
      pictures.push_back(drawn(titles_[i], charts_[i]));
    return pictures;
  }

 private:
  void collect(const Measured& measured, const Shown& shown, bool one) {
    for (const Figure& figure : measured.figures) {
      Chart& chart = chart_of(figure);
      for (const FigureCurve& source : figure.curves) add(chart, source, shown, one);
    }
  }

  Chart& chart_of(const Figure& figure) {
    const auto found = std::find(titles_.begin(), titles_.end(), figure.title);
    if (found != titles_.end()) return charts_[std::size_t(found - titles_.begin())];
    titles_.push_back(figure.title);
    Chart& chart = charts_.emplace_back();
    chart.x_label = figure.x_label;
    chart.y_label = figure.y_label;
    chart.logarithmic_x = figure.log_x;
    chart.logarithmic_y = figure.log_y;
    return chart;
  }

  /// References that several runs share are drawn once, and named after the runs where they
  /// differ.
  static void add(Chart& chart, const FigureCurve& source, const Shown& shown, bool one) {
    std::string name = joined(shown.name, source.name, one);
    if (source.reference) {
      for (const Curve& known : chart.curves) {
        if (known.x == source.x && known.y == source.y) return;
      }
      const bool taken = std::any_of(chart.curves.begin(), chart.curves.end(),
                                     [&](const Curve& known) { return known.name == source.name; });
      if (!taken) name = source.name;
    }
    chart.curves.push_back(curve_of(source, shown.colour, name));
  }

  const CaseResult& result_;
  std::vector<std::string> titles_;
  std::vector<Chart> charts_;
};

/// Whether a check's runs differ in size: an angle or an aspect ratio may be swept as well.
bool has_sizes(const CaseResult& result, const CheckResult& check) {
  double smallest = INFINITY, largest = 0;
  for (const RunResult& run : result.runs) {
    const bool judged = std::any_of(check.runs.begin(), check.runs.end(),
                                    [&](const Judged& j) { return j.run == run.plan.label; });
    if (!judged) continue;
    smallest = std::min(smallest, run.plan.size);
    largest = std::max(largest, run.plan.size);
  }
  return largest > 1.001 * smallest;
}

/// Names of quantities that some series has at two sizes or more, all positive.
std::vector<std::string> converging(const CaseResult& result) {
  std::vector<std::string> names;
  for (const CheckResult& check : result.checks) {
    const std::string& name = check.expectation.quantity;
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const bool positive = std::all_of(check.runs.begin(), check.runs.end(),
                                      [](const Judged& run) { return run.measured > 0; });
    if (positive && has_sizes(result, check)) names.push_back(name);
  }
  return names;
}

class ConvergencePlot {
 public:
  ConvergencePlot(const CaseResult& result, std::string quantity)
      : result_(result), quantity_(std::move(quantity)) {}

  Picture draw() {
    chart_.x_label = result_.sweep.size_label;
    chart_.y_label = quantity_;
    chart_.logarithmic_x = chart_.logarithmic_y = true;
    for (std::size_t s = 0; s < result_.sweep.series.size(); ++s) add_series(s);
    for (const PeerResult& peer : result_.text.peers) {
      if (peer.quantity == quantity_) add_peer(peer);
    }
    for (const CheckResult& check : result_.checks) {
      if (check.expectation.quantity != quantity_ || check.expectation.compared) continue;
      if (check.expectation.kind == CheckKind::order) add_band(check);
      if (check.expectation.kind == CheckKind::at_most) add_bound(check);
    }
    return drawn("Convergence: " + quantity_, chart_);
  }

 private:
  void add_series(std::size_t series) {
    std::vector<std::pair<double, double>> points;
    for (const RunResult& run : result_.runs) {
      const Quantity* const quantity = run.measured.find(quantity_);
      if (run.plan.series == series && quantity != nullptr)
        points.emplace_back(run.plan.size, quantity->value);
    }
    if (points.empty()) return;
    std::sort(points.begin(), points.end());
    Curve curve;
    for (const auto& [h, e] : points) {
      curve.x.push_back(h);
      curve.y.push_back(e);
    }
    curve.colour = colour_of(series);
    curve.dots = true;
    curve.name = result_.sweep.series[series].name;
    chart_.curves.push_back(std::move(curve));
  }

  /// Another code's numbers, at the sizes of this case's runs.
  void add_peer(const PeerResult& peer) {
    Curve curve;
    for (std::size_t i = 0; i < peer.at.size(); ++i) {
      for (const RunResult& run : result_.runs) {
        if (run.plan.series_name != peer.series || !same_swept(run.plan.value, peer.at[i]))
          continue;
        curve.x.push_back(run.plan.size);
        curve.y.push_back(peer.values[i]);
      }
    }
    if (curve.x.empty()) return;
    curve.colour = black;
    curve.dots = true;
    curve.name = peer.code;
    chart_.curves.push_back(std::move(curve));
  }

  std::size_t series_of(const CheckResult& check) const {
    for (std::size_t s = 0; s < result_.sweep.series.size(); ++s) {
      if (result_.sweep.series[s].name == check.series) return s;
    }
    return 0;
  }

  double size_of(const std::string& label) const {
    for (const RunResult& run : result_.runs) {
      if (run.plan.label == label) return run.plan.size;
    }
    return std::nan("");
  }

  /// The two slopes of the asserted order, from the coarser of the two finest errors on.
  void add_band(const CheckResult& check) {
    const std::size_t n = check.runs.size();
    if (n < 2) return;
    const double h0 = size_of(check.runs[n - 2].run), h1 = size_of(check.runs[n - 1].run);
    const double e0 = check.runs[n - 2].measured;
    for (const double order : check.expectation.limits) {
      Curve slope;
      slope.x = {h1, h0};
      slope.y = {e0 * std::pow(h1 / h0, order), e0};
      slope.colour = colour_of(series_of(check));
      slope.dashed = true;
      slope.thickness = 1.5;
      chart_.curves.push_back(std::move(slope));
    }
    if (!band_named_) chart_.curves.back().name = "asserted order";
    band_named_ = true;
  }

  /// A short bar at each run's bound.
  void add_bound(const CheckResult& check) {
    for (const Judged& run : check.runs) {
      const double h = size_of(run.run);
      Curve mark;
      mark.x = {h * 0.94, h * 1.06};
      mark.y = {run.limit, run.limit};
      mark.colour = colour_of(series_of(check));
      mark.thickness = 4;
      if (!bound_named_) mark.name = "asserted bound";
      bound_named_ = true;
      chart_.curves.push_back(std::move(mark));
    }
  }

  const CaseResult& result_;
  std::string quantity_;
  Chart chart_;
  bool band_named_ = false, bound_named_ = false;
};

}  // namespace

std::vector<Picture> pictures(const CaseResult& result) {
  std::vector<Picture> all = FigureCollector(result).all();
  for (const std::string& name : converging(result))
    all.push_back(ConvergencePlot(result, name).draw());
  return all;
}

}  // namespace scree::verify
