// SPDX-License-Identifier: Apache-2.0
//
// There is no closed form; the reference is the converged finite element solution that A.
// Sadeghirad, R. M. Brannon, J. Burghardt, A convected particle domain interpolation technique to
// extend applicability of the material point method for problems involving massive deformations,
// Int. J. Numer. Meth. Engng 86 (2011) 1435, section 5.3, compare with: vertical displacement of
// the lower free corner of a beam of 4 m by 1 m, neo-Hookean, E = 1 MPa, nu = 0.3, rho = 1050
// kg/m^3, g = 10 m/s^2 from t = 0 on. Digitised as published with MaterialPointSolver.jl
// (FEM_cantilever_beam.csv).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::cantilever {

/// Time (s) and displacement (m) of the corner.
inline constexpr std::array<std::array<double, 2>, 23> finite_elements{
    {{0.21, -0.28}, {0.31, -0.59}, {0.40, -1.05}, {0.49, -1.48}, {0.60, -2.10}, {0.70, -2.51},
     {0.79, -2.81}, {0.90, -3.14}, {1.03, -3.28}, {1.19, -3.17}, {1.35, -3.01}, {1.43, -2.97},
     {1.60, -3.15}, {1.68, -3.17}, {1.81, -3.04}, {2.00, -2.34}, {2.19, -1.44}, {2.36, -0.63},
     {2.51, -0.08}, {2.60, 0.01},  {2.73, -0.13}, {2.86, -0.43}, {2.98, -0.76}}};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double spacing = run.number("cell") / run.number("ppd");
    std::vector<double> t, u, shown_t, shown_u;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      t.push_back(run.frames[static_cast<std::size_t>(f)].time);
      const std::optional<double> displacement = corner(run.frame(f), spacing);
      u.push_back(displacement.value_or(0));
      if (!displacement) continue;
      shown_t.push_back(t.back());
      shown_u.push_back(u.back());
    }
    const auto first_half = u.begin() + static_cast<std::ptrdiff_t>(u.size() / 2);
    const auto lowest = std::min_element(u.begin(), first_half);
    const auto back = std::max_element(first_half, u.end());
    out.value("lowest", *lowest, -3.28);
    out.value("time of return", peak_time(t, u, static_cast<std::size_t>(back - u.begin())), 2.60);
    double sum = 0;
    std::vector<double> px, py;
    for (const auto& [time, displacement] : finite_elements) {
      const double off = interpolate(t, u, time) - displacement;
      sum += off * off;
      px.push_back(time);
      py.push_back(displacement);
    }
    out.value("distance", std::sqrt(sum / static_cast<double>(finite_elements.size())) / 3.28);
    out.figure("Lower free corner", "time (s)", "vertical displacement (m)")
        .computed(shown_t, shown_u)
        .published(px, py, "finite elements");
  }

 private:
  /// Displacement at the corner, by the line through the two particles next to it on the diagonal;
  /// nothing where a torn beam has lost one of them.
  static std::optional<double> corner(const ParticleFrame& frame, double spacing) {
    std::optional<double> u[2];
    for (std::size_t p = 0; p < frame.size(); ++p) {
      for (int k = 0; k < 2; ++k) {
        const double off = (k + 0.5) * spacing;
        const bool here = std::abs(frame.X(p)[0] - (4 - off)) < spacing / 4 &&
                          std::abs(frame.X(p)[1] - (5 + off)) < spacing / 4;
        if (here) u[k] = frame.x(p)[1] - frame.X(p)[1];
      }
    }
    if (!u[0] || !u[1]) return std::nullopt;
    return 1.5 * *u[0] - 0.5 * *u[1];
  }

  /// Vertex of the parabola through a largest sample and its neighbours.
  static double peak_time(const std::vector<double>& t, const std::vector<double>& u,
                          std::size_t i) {
    if (i == 0 || i + 1 >= u.size()) return t[i];
    const double a = u[i - 1], b = u[i], c = u[i + 1], h = t[i] - t[i - 1];
    return t[i] + h * (a - c) / (2 * (a - 2 * b + c));
  }

  static double interpolate(const std::vector<double>& t, const std::vector<double>& u, double at) {
    std::size_t i = 1;
    while (i + 1 < t.size() && t[i] < at) ++i;
    return u[i - 1] + (u[i] - u[i - 1]) * (at - t[i - 1]) / (t[i] - t[i - 1]);
  }
};

}  // namespace scree::verify::cases::cantilever
