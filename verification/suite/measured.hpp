// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scree::verify {

/// A line or dots of a figure.
struct FigureCurve {
  std::string name;  ///< added to the name of the series
  std::vector<double> x, y;
  bool reference = false;  ///< exact or published, not computed
  bool dots = false;
};

/// What a case shows in the report: its solution over the reference, a history of an error, ...
class Figure {
 public:
  Figure(std::string title_, std::string x, std::string y)
      : title(std::move(title_)), x_label(std::move(x)), y_label(std::move(y)) {}

  /// A curve of the run. Those of each series' finest run are drawn, or of all runs of one size.
  Figure& computed(std::vector<double> x, std::vector<double> y, const std::string& name = "") {
    curves.push_back({name, std::move(x), std::move(y), false, false});
    return *this;
  }
  /// The same as dots, for particles.
  Figure& particles(std::vector<double> x, std::vector<double> y, const std::string& name = "") {
    curves.push_back({name, std::move(x), std::move(y), false, true});
    return *this;
  }
  /// What it should be. Equal curves of several runs are drawn once.
  Figure& exact(std::vector<double> x, std::vector<double> y, const std::string& name = "exact") {
    curves.push_back({name, std::move(x), std::move(y), true, false});
    return *this;
  }
  /// Published points.
  Figure& published(std::vector<double> x, std::vector<double> y, const std::string& name) {
    curves.push_back({name, std::move(x), std::move(y), true, true});
    return *this;
  }
  Figure& logarithmic_y() {
    log_y = true;
    return *this;
  }
  Figure& logarithmic_x() {
    log_x = true;
    return *this;
  }

  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<FigureCurve> curves;
};

/// One number of a run, and what it should be where that is one number, too.
struct Quantity {
  std::string name;
  double value = 0;
  std::optional<double> exact;
};

/// What the code of a case hands over for one run.
class Measured {
 public:
  /// A quantity that expect.toml judges. Errors are best given relative to what they are errors of.
  void value(const std::string& name, double measured) {
    quantities.push_back({name, measured, std::nullopt});
  }
  /// A quantity with its exact value, for `within` in expect.toml.
  void value(const std::string& name, double measured, double exact) {
    quantities.push_back({name, measured, exact});
  }
  /// Begins a figure. The reference is valid until the next figure begins.
  Figure& figure(const std::string& title, const std::string& x_label, const std::string& y_label) {
    return figures.emplace_back(title, x_label, y_label);
  }

  const Quantity* find(const std::string& name) const {
    for (const Quantity& quantity : quantities) {
      if (quantity.name == name) return &quantity;
    }
    return nullptr;
  }

  std::vector<Quantity> quantities;
  std::vector<Figure> figures;
};

}  // namespace scree::verify
