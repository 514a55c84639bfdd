// SPDX-License-Identifier: Apache-2.0
#include "app/element_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postproc/plot/chart.hpp"
#include "solver/element/yield_locus.hpp"

namespace scree {
namespace {

constexpr Colour path_colour{0.0, 0.33, 0.65}, limit_colour{0.80, 0.25, 0.10};

/// A unit in which the stresses of a test are numbers that can be read.
struct StressUnit {
  double size;  ///< Pa
  const char* name;
};

StressUnit stress_unit(const ElementResult& result) {
  double largest = 0;
  for (const ElementRow& row : result.rows) {
    largest = std::max({largest, std::abs(row.pressure()), row.deviatoric()});
  }
  if (largest >= 1e7) return {1e6, "MPa"};
  return largest >= 1e3 ? StressUnit{1e3, "kPa"} : StressUnit{1, "Pa"};
}

/// Zero where a value is only rounding of numbers of this size.
double settled(double value, double size) { return std::abs(value) > 1e-9 * size ? value : 0.0; }

double largest_stress(const ElementRow& row) {
  const Sym3<double>& s = row.cauchy;
  return std::max({std::abs(s.xx), std::abs(s.yy), std::abs(s.zz), std::abs(s.xy)});
}

/// q without rounding.
double deviatoric(const ElementRow& row) { return settled(row.deviatoric(), largest_stress(row)); }

/// The points that a function of a row gives.
template <class X, class Y>
Curve curve_of(const ElementResult& result, X x, Y y) {
  Curve curve;
  for (const ElementRow& row : result.rows) {
    curve.x.push_back(x(row));
    curve.y.push_back(y(row));
  }
  curve.colour = path_colour;
  curve.start = true;
  return curve;
}

/// The strain along which a test is plotted, in percent unless it is a flow.
class StrainAxis {
 public:
  explicit StrainAxis(const ElementResult& result, LabTest type)
      : shear_(type == LabTest::simple_shear) {
    const PathStrain& last = result.rows.back().strain;
    if (type == LabTest::gradient) shear_ = std::abs(last.shear) > std::abs(last.axial);
    for (const ElementRow& row : result.rows) large_ |= shear_ && std::abs(row.strain.shear) > 2;
  }
  double operator()(const ElementRow& row) const {
    return (large_ ? 1 : 100) * (shear_ ? row.strain.shear : row.strain.axial);
  }
  bool shear() const { return shear_; }
  const char* label() const {
    if (large_) return "Shear strain";
    return shear_ ? "Shear strain (%)" : "Axial strain (%)";
  }

 private:
  bool shear_ = false, large_ = false;
};

Chart stress_strain(const ElementResult& result, const StrainAxis& strain, StressUnit unit,
                    LabTest type) {
  Chart chart;
  chart.x_label = strain.label();
  if (type == LabTest::isotropic || type == LabTest::oedometer) {
    const bool axial = type == LabTest::oedometer;
    chart.y_label = fmt::format("{} ({})", axial ? "Axial stress" : "Pressure p", unit.name);
    chart.curves.push_back(curve_of(result, strain, [&](const ElementRow& row) {
      return (axial ? -row.cauchy.xx : row.pressure()) / unit.size;
    }));
  } else {
    chart.y_label =
        fmt::format("{} ({})", strain.shear() ? "Shear stress" : "Deviatoric stress q", unit.name);
    chart.curves.push_back(curve_of(result, strain, [&](const ElementRow& row) {
      return (strain.shear() ? row.cauchy.xy : deviatoric(row)) / unit.size;
    }));
  }
  return chart;
}

Chart stress_path(const ElementResult& result, StressUnit unit) {
  Chart chart;
  chart.x_label = fmt::format("Pressure p ({})", unit.name);
  chart.y_label = fmt::format("Deviatoric stress q ({})", unit.name);
  Curve path = curve_of(
      result, [&](const ElementRow& row) { return row.pressure() / unit.size; },
      [&](const ElementRow& row) { return deviatoric(row) / unit.size; });
  path.name = "path";
  Curve yield;
  for (const auto& [p, q] : yield_locus(result)) {
    yield.x.push_back(p / unit.size);
    yield.y.push_back(q / unit.size);
  }
  yield.colour = limit_colour;
  yield.dashed = true;
  yield.name = yield.x.empty() ? "" : "yield in triaxial compression, at the end";
  chart.curves = {yield, path};
  return chart;
}

/// Or the pore pressure, where the volume stays.
Chart volume_strain(const ElementResult& result, const StrainAxis& strain, StressUnit unit) {
  Chart chart;
  chart.x_label = strain.label();
  if (result.rows.front().pore_pressure) {
    chart.y_label = fmt::format("Excess pore pressure ({})", unit.name);
    chart.curves.push_back(curve_of(result, strain, [&](const ElementRow& row) {
      return settled(*row.pore_pressure, largest_stress(row)) / unit.size;
    }));
    return chart;
  }
  chart.y_label = "Volumetric strain (%)";
  chart.curves.push_back(curve_of(result, strain, [](const ElementRow& row) {
    return 100 * settled(row.strain.volumetric, 1e3);
  }));
  return chart;
}

Chart void_ratio(const ElementResult& result, StressUnit unit) {
  Chart chart;
  const auto [low, high] = std::minmax_element(
      result.rows.begin(), result.rows.end(),
      [](const ElementRow& a, const ElementRow& b) { return a.pressure() < b.pressure(); });
  chart.logarithmic_x = high->pressure() > 2 * low->pressure();
  chart.x_label =
      fmt::format("Pressure p ({}){}", unit.name, chart.logarithmic_x ? ", logarithmic" : "");
  chart.y_label = "Void ratio";
  chart.curves.push_back(curve_of(
      result, [&](const ElementRow& row) { return row.pressure() / unit.size; },
      [](const ElementRow& row) { return row.void_ratio; }));
  return chart;
}

/// Where p is positive; rows without pressure have no ratio.
Chart stress_ratio(const ElementResult& result, const StrainAxis& strain) {
  double largest = 0;
  for (const ElementRow& row : result.rows) largest = std::max(largest, row.pressure());
  Chart chart;
  chart.x_label = strain.label();
  chart.y_label = "Stress ratio q/p";
  Curve curve;
  for (const ElementRow& row : result.rows) {
    if (!(row.pressure() > 1e-6 * largest)) continue;
    curve.x.push_back(strain(row));
    curve.y.push_back(deviatoric(row) / row.pressure());
  }
  curve.colour = path_colour;
  chart.curves.push_back(curve);
  return chart;
}

}  // namespace

const char* const plot_mark = "scree element";

void plot_element(const ElementDeck& deck, const ElementResult& result, const std::string& path) {
  const StressUnit unit = stress_unit(result);
  const StrainAxis strain(result, deck.driven.type);
  const bool compressed = std::all_of(result.rows.begin(), result.rows.end(),
                                      [](const ElementRow& row) { return row.pressure() > 0; });
  std::vector<Chart> charts{stress_strain(result, strain, unit, deck.driven.type),
                            stress_path(result, unit), volume_strain(result, strain, unit)};
  charts.push_back(result.void_ratio_known && compressed ? void_ratio(result, unit)
                                                         : stress_ratio(result, strain));
  const std::string title = deck.title.empty() ? deck.name : deck.title;
  const std::string subtitle =
      fmt::format("{}, {} steps, {}; compression positive", lab_test_name(deck.driven.type),
                  result.rows.back().step, deck.materials.front().model);
  draw_page(title, subtitle, charts).write_png(path, plot_mark);
}

}  // namespace scree
