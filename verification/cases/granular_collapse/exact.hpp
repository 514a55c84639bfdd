// SPDX-License-Identifier: Apache-2.0
//
// Collapse of a column of dry grains of width d0 and aspect ratio a against a wall, plane strain.
//
// Experiments (run-out (d_inf - d0)/d0 and height h_inf/d0 of the deposit):
//   G. Lube, H. Huppert, R. Sparks, M. Freundt, Phys. Rev. E 72, 2005:
//     1.2 a (a < 1.8), 1.9 a^(2/3) (a > 2.8);   a (a < 1.15), 0.65 a^(2/5).
//   E. Lajeunesse, J. Monnier, G. Homsy, Phys. Fluids 17, 2005:
//     1.2 a (a < 3), 1.9 a^(2/3);               a (a < 0.7), a^(1/3).
//   H. Bui, R. Fukagawa, K. Sako, S. Ohno, Int. J. Numer. Anal. Meth. Geomech. 32, 2008: aluminium
//     bars, 200 x 100 mm, phi = 19.8 deg; the points below are read off their photograph.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "verification/suite/front.hpp"
#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::granular_collapse {

inline double lube_run_out(double a) { return a < 2.3 ? 1.2 * a : 1.9 * std::pow(a, 2.0 / 3); }
inline double lajeunesse_height(double a) { return a < 0.7 ? a : std::cbrt(a); }

/// Points (x, y) [m] of a photograph.
struct Points {
  std::vector<double> x, y;
};
inline const Points& bui_surface() {
  static const Points points{{0.0001, 0.0196, 0.0398, 0.0600, 0.0803, 0.1001, 0.1203, 0.1401,
                              0.1603, 0.1802, 0.2000, 0.2202, 0.2408, 0.2622, 0.2820, 0.3022,
                              0.3221, 0.3423, 0.3622, 0.3824, 0.4022, 0.4221, 0.4423},
                             {0.0992, 0.0993, 0.0959, 0.0890, 0.0844, 0.0776, 0.0722, 0.0665,
                              0.0616, 0.0539, 0.0474, 0.0425, 0.0348, 0.0307, 0.0265, 0.0215,
                              0.0189, 0.0136, 0.0109, 0.0079, 0.0037, 0.0022, 0.0015}};
  return points;
}
/// Between the soil that moved by more than 1 mm and that which did not.
inline const Points& bui_failure() {
  static const Points points{
      {0.0212, 0.0398, 0.0600, 0.0797, 0.0999, 0.1196, 0.1394, 0.1596, 0.1794},
      {0.0989, 0.0901, 0.0802, 0.0652, 0.0545, 0.0368, 0.0257, 0.0104, 0.0005}};
  return points;
}

struct Case {
  static void measure(const Run& run, Measured& out) {
    const HistoryRow& last = run.history.back();
    out.value("grains lost", 1 - last.mass / run.history[0].mass);
    out.value("rest",
              last.kinetic_energy / (last.mass * run.number("g") * run.number("height") / 2));
    if (run.text("kind") == "sand") {
      measure_scaling(run, out);
    } else {
      measure_bars(run, out);
    }
  }

  /// The exponent of the height of the deposit and that the run-out grows.
  static void compare(const std::vector<const Run*>& runs, Measured& out) {
    std::vector<double> aspect, run_out;
    for (const Run* run : runs) {
      if (run->text("kind") != "sand") continue;
      aspect.push_back(run->number("aspect"));
      run_out.push_back(run_out_of(*run));
    }
    if (aspect.size() < 2) return;
    std::vector<double> published;
    for (double a : aspect) published.push_back(lube_run_out(a));
    out.value("run-out grows", std::is_sorted(run_out.begin(), run_out.end()) ? 1 : 0);
    out.figure("Run-out of sand", "aspect ratio", "(d - d0)/d0")
        .computed(aspect, run_out, "sand")
        .published(aspect, published, "Lube et al. 2005");
  }

 private:
  static double front(const Run& run) {
    const ParticleFrame end = run.frame();
    std::vector<double> x;
    for (std::size_t p = 0; p < end.size(); ++p) x.push_back(end.x(p)[0]);
    return front_of(std::move(x));
  }
  static double run_out_of(const Run& run) { return front(run) / run.number("width") - 1; }

  /// Height of the deposit at the left edges of columns of one cell: its highest particle and half
  /// the distance of two of them.
  static Points surface_of(const Run& run) {
    const ParticleFrame end = run.frame();
    const double cell = run.number("cell");
    Points surface;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const std::size_t i = static_cast<std::size_t>(std::max(end.x(p)[0], 0.0) / cell);
      while (surface.x.size() <= i) {
        surface.x.push_back((double(surface.x.size()) + 0.5) * cell);
        surface.y.push_back(0);
      }
      surface.y[i] = std::max(surface.y[i], end.x(p)[1] + cell / run.number("ppd") / 2);
    }
    return surface;
  }

  static double at(const Points& line, double x) {
    const auto after = std::upper_bound(line.x.begin(), line.x.end(), x);
    if (after == line.x.begin()) return line.y.front();
    if (after == line.x.end()) return 0;
    const std::size_t i = std::size_t(after - line.x.begin());
    const double share = (x - line.x[i - 1]) / (line.x[i] - line.x[i - 1]);
    return line.y[i - 1] + share * (line.y[i] - line.y[i - 1]);
  }

  static void measure_scaling(const Run& run, Measured& out) {
    const double a = run.number("aspect"), width = run.number("width");
    const Points surface = surface_of(run);
    const double run_out = run_out_of(run), height = surface.y.front() / width;
    out.value("run-out/a", run_out / a, lube_run_out(a) / a);
    out.value("height", height, lajeunesse_height(a));
    std::vector<double> x, y;
    for (std::size_t i = 0; i < surface.x.size(); ++i) {
      x.push_back(surface.x[i] / width);
      y.push_back(surface.y[i] / width);
    }
    out.figure("Deposit of sand", "x/d0", "y/d0").computed(x, y);
  }

  static void measure_bars(const Run& run, Measured& out) {
    const Points surface = surface_of(run);
    const Points& measured = bui_surface();
    double squares = 0;
    for (std::size_t i = 0; i < measured.x.size(); ++i) {
      const double off = at(surface, measured.x[i]) - measured.y[i];
      squares += off * off / double(measured.x.size());
    }
    out.value("surface error", std::sqrt(squares));
    out.value("front", front(run), 0.402);  // of the area below the points, 99.5 %
    const Points failure = failure_line(run);
    double largest = 0;
    for (std::size_t i = 0; i < failure.x.size(); ++i)
      largest = std::max(largest, std::abs(failure.x[i] - bui_failure().x[i]));
    out.value("failure line error", largest);
    out.figure("Aluminium bars", "x (m)", "y (m)")
        .computed(surface.x, surface.y, "surface")
        .computed(failure.x, failure.y, "moved by 1 mm")
        .published(measured.x, measured.y, "Bui et al. 2008, surface")
        .published(bui_failure().x, bui_failure().y, "Bui et al. 2008, failure line");
  }

  /// At the heights of the experiment's failure line: where the grains, by their first place, begin
  /// to have moved by more than 1 mm (mean over the particles of a layer of one cell and of columns
  /// of one cell).
  static Points failure_line(const Run& run) {
    const ParticleFrame end = run.frame();
    const double cell = run.number("cell");
    Points line;
    for (double y : bui_failure().y) {
      const double low = std::clamp(y - cell / 2, 0.0, run.number("height") - cell);
      double first = run.number("width");
      for (std::size_t p = 0; p < end.size(); ++p) {
        if (end.X(p)[1] < low || end.X(p)[1] >= low + cell) continue;
        if (std::hypot(end.x(p)[0] - end.X(p)[0], end.x(p)[1] - end.X(p)[1]) > 1e-3)
          first = std::min(first, end.X(p)[0]);
      }
      line.x.push_back(first);
      line.y.push_back(y);
    }
    return line;
  }
};

}  // namespace scree::verify::cases::granular_collapse
