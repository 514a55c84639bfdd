// SPDX-License-Identifier: Apache-2.0
#include "app/element_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/element_axes.hpp"
#include "solver/element/yield_locus.hpp"

namespace scree {
namespace {

constexpr Colour path_colour{0.0, 0.33, 0.65}, limit_colour{0.80, 0.25, 0.10};

/// Whether all y of a chart's curves are one value.
bool says_nothing(const Chart& chart) {
  double low = 0, high = 0, size = 0;
  bool first = true;
  for (const Curve& curve : chart.curves) {
    for (const double y : curve.y) {
      low = first ? y : std::min(low, y);
      high = first ? y : std::max(high, y);
      size = std::max(size, std::abs(y));
      first = false;
    }
  }
  return !(high - low > 1e-6 * size);
}

class ElementCharts {
 public:
  ElementCharts(const ElementDeck& deck, const ElementResult& result)
      : result_(result),
        type_(deck.driven.type),
        stress_(deck, result),
        strain_(result, deck.driven.type) {}

  std::vector<Chart> all() const {
    std::vector<Chart> charts{stress_strain(), stress_path()};
    const auto add = [&](Chart chart) {
      if (charts.size() < 4 && !says_nothing(chart)) charts.push_back(std::move(chart));
    };
    if (has_pore_pressure()) {
      add(pore_pressure());
    } else if (type_ != LabTest::isotropic) {  // there it is the axis
      add(volume_strain());
    }
    if (result_.void_ratio_known && compressed()) add(void_ratio());
    add(stress_ratio());
    return charts;
  }

 private:
  bool has_pore_pressure() const { return result_.rows.front().pore_pressure.has_value(); }
  bool compressed() const {
    return std::all_of(result_.rows.begin(), result_.rows.end(),
                       [&](const ElementRow& row) { return stress_.p(row) > 0; });
  }

  /// The points that a function of a row gives over another.
  template <class X, class Y>
  Curve curve(X x, Y y) const {
    Curve result;
    for (const ElementRow& row : result_.rows) {
      result.x.push_back(x(row));
      result.y.push_back(y(row));
    }
    result.colour = path_colour;
    result.start = true;
    return result;
  }

  template <class Y>
  Chart over_strain(const std::string& y_label, Y y) const {
    Chart chart;
    chart.x_label = strain_.label();
    chart.y_label = y_label;
    chart.curves.push_back(curve(strain_, y));
    return chart;
  }

  /// "Pressure p" -> "Pressure p (kPa)"
  std::string with_unit(const char* name) const {
    return fmt::format("{} ({})", name, stress_.unit());
  }

  Chart stress_strain() const {
    if (type_ == LabTest::isotropic) {
      return over_strain(with_unit("Pressure p"),
                         [&](const ElementRow& row) { return stress_.shown(stress_.p(row)); });
    }
    if (type_ == LabTest::oedometer) {
      return over_strain(with_unit("Axial stress"), [&](const ElementRow& row) {
        return stress_.shown(stress_.settled(-row.cauchy.xx));
      });
    }
    if (strain_.shear()) {
      return over_strain(with_unit("Shear stress"), [&](const ElementRow& row) {
        return stress_.shown(stress_.settled(row.cauchy.xy));
      });
    }
    return over_strain(with_unit("Deviatoric stress q"),
                       [&](const ElementRow& row) { return stress_.shown(stress_.q(row)); });
  }

  /// The pressures of the path and some more, at least half as wide as q is high.
  PressureRange pressures() const {
    PressureRange range;
    double highest_q = 0;
    for (const ElementRow& row : result_.rows) {
      range.low = std::min(range.low, stress_.p(row));
      range.high = std::max(range.high, 1.15 * stress_.p(row));
      highest_q = std::max(highest_q, std::abs(stress_.q(row)));
    }
    const double missing = 0.5 * highest_q - (range.high - range.low);
    if (missing > 0) range = {range.low - 0.5 * missing, range.high + 0.5 * missing};
    return range;
  }

  Curve yield(const ShearDirection& direction, double sign) const {
    Curve limit;
    for (const auto& [p, q] : yield_locus(result_, direction, pressures())) {
      limit.x.push_back(stress_.shown(p));
      limit.y.push_back(sign * stress_.shown(q));
    }
    limit.colour = limit_colour;
    limit.dashed = true;
    return limit;
  }

  std::vector<Curve> yields() const {
    const auto any = [&](double sign) {
      return std::any_of(result_.rows.begin(), result_.rows.end(),
                         [&](const ElementRow& row) { return sign * stress_.q(row) > 0; });
    };
    std::vector<Curve> limits;
    if (!axisymmetric(type_)) {
      limits = {yield(shear_direction(result_.rows.back(), stress_.noise()), 1)};
    } else {
      if (any(1) || !any(-1)) limits.push_back(yield(triaxial_compression, 1));
      if (any(-1)) limits.push_back(yield(triaxial_extension, -1));
    }
    std::erase_if(limits, [](const Curve& limit) { return limit.x.empty(); });
    if (!limits.empty())
      limits.front().name = flows_beyond(limits) ? "slow flow" : "yield at the end";
    return limits;
  }

  /// Whether the end of the path lies beyond the limits: the law allows more stress to fast flow.
  bool flows_beyond(const std::vector<Curve>& limits) const {
    const double p = stress_.shown(stress_.p(result_.rows.back()));
    const double q = stress_.shown(stress_.q(result_.rows.back()));
    for (const Curve& limit : limits) {
      for (std::size_t i = 1; i < limit.x.size(); ++i) {
        if (!(limit.x[i - 1] <= p && p < limit.x[i])) continue;
        const double share = (p - limit.x[i - 1]) / (limit.x[i] - limit.x[i - 1]);
        const double there = limit.y[i - 1] + share * (limit.y[i] - limit.y[i - 1]);
        // Straight lines between points of a curved surface leave out less than this.
        if (q * there > 0 && std::abs(q) > 1.05 * std::abs(there)) return true;
      }
    }
    return false;
  }

  Chart stress_path() const {
    Chart chart;
    chart.x_label = with_unit("Pressure p");
    chart.y_label = with_unit("Deviatoric stress q");
    chart.curves = yields();
    chart.curves.push_back(
        curve([&](const ElementRow& row) { return stress_.shown(stress_.p(row)); },
              [&](const ElementRow& row) { return stress_.shown(stress_.q(row)); }));
    if (chart.curves.size() > 1) chart.curves.back().name = "path";
    return chart;
  }

  Chart pore_pressure() const {
    return over_strain(with_unit("Excess pore pressure"), [&](const ElementRow& row) {
      return stress_.shown(stress_.settled(*row.pore_pressure));
    });
  }

  Chart volume_strain() const {
    return over_strain("Volumetric strain (%)", [](const ElementRow& row) {
      const double v = row.strain.volumetric;
      return std::abs(v) > 1e-6 ? 100 * v : 0.0;
    });
  }

  Chart void_ratio() const {
    Chart chart;
    const auto [low, high] = std::minmax_element(
        result_.rows.begin(), result_.rows.end(),
        [](const ElementRow& a, const ElementRow& b) { return a.pressure() < b.pressure(); });
    chart.logarithmic_x = high->pressure() > 2 * low->pressure();
    chart.x_label = with_unit("Pressure p") + (chart.logarithmic_x ? ", logarithmic" : "");
    chart.y_label = "Void ratio";
    chart.curves.push_back(
        curve([&](const ElementRow& row) { return stress_.shown(stress_.p(row)); },
              [](const ElementRow& row) { return row.void_ratio; }));
    return chart;
  }

  /// Where p is positive; rows without pressure have no ratio.
  Chart stress_ratio() const {
    double largest = 0;
    for (const ElementRow& row : result_.rows) largest = std::max(largest, stress_.p(row));
    Chart chart;
    chart.x_label = strain_.label();
    chart.y_label = "Stress ratio q/p";
    Curve ratio;
    for (const ElementRow& row : result_.rows) {
      if (!(stress_.p(row) > 1e-6 * largest)) continue;
      ratio.x.push_back(strain_(row));
      ratio.y.push_back(stress_.q(row) / stress_.p(row));
    }
    ratio.colour = path_colour;
    chart.curves.push_back(ratio);
    return chart;
  }

  const ElementResult& result_;
  LabTest type_;
  StressScale stress_;
  StrainAxis strain_;
};

}  // namespace

std::vector<Chart> element_charts(const ElementDeck& deck, const ElementResult& result) {
  return ElementCharts(deck, result).all();
}

}  // namespace scree
