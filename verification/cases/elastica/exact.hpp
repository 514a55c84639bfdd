// SPDX-License-Identifier: Apache-2.0
//
// Euler's elastica: an inextensible beam, clamped at s = 0, under its weight w per length. With the
// slope theta below the horizontal the moment at s is that of the weight beyond it, so
//   E I theta'' = -w (L - s) cos(theta),   theta(0) = 0,   theta'(L) = 0,
//   x' = cos(theta), y' = sin(theta)      (L. D. Landau, E. M. Lifshitz, Theory of Elasticity, 19).
// For w L^3/(E I) = 1 and 2 the tip drops by 0.1235 and 0.2385 L. Shear of a beam that is not
// slender turns its axis by gamma = w (L - s) cos(theta)/(kappa G A) more (Timoshenko, kappa =
// 5/6), which adds (h/L)^2/10 of w L^3/(E I): 0.8 % of the drop for h = L/10. E I = E h^3/12 for nu
// = 0.
// Under a load P at the end, of fixed direction, w (L - s) is P, and P L^2/(E I) takes the place of
// w L^3/(E I) in both equations: drops of 0.3017 and 0.4935 L for 1 and 2 (K. E. Bisshopp, D. C.
// Drucker, Q. Appl. Math. 3, 1945), without shear, which adds as much of P L^2/(E I) as above,
// (h/L)^2/5 of it: 0.7 % of the drop.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::elastica {

/// The axis of a beam of length 1, by fourth-order Runge-Kutta steps and shooting.
class Elastica {
 public:
  /// \param load w L^3/(E I) or, at the end, P L^2/(E I)
  /// \param slender (h/L)^2
  Elastica(double load, double slender, bool at_end)
      : load_(load), shear_(load * slender / 5), at_end_(at_end) {
    double low = 0, high = load;  // theta'(0): theta'(L) grows with it
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (trace(middle).back()[1] > 0 ? high : low) = middle;
    }
    states_ = trace(low);
  }

  /// Place of s in [0, 1]: along the unloaded axis and below it.
  std::array<double, 2> at(double s) const {
    const double where = s * steps;
    const int i = std::min(static_cast<int>(where), steps - 1);
    const double part = where - i;
    std::array<double, 2> place{};
    for (int a = 0; a < 2; ++a)
      place[a] = (1 - part) * states_[i][2 + a] + part * states_[i + 1][2 + a];
    return place;
  }

 private:
  using State = std::array<double, 4>;  ///< theta, theta', x, y
  static constexpr int steps = 1000;

  State slope(double s, const State& now) const {
    const double beyond = at_end_ ? 1 : 1 - s;  // the share of the load
    const double gamma = shear_ * beyond * std::cos(now[0]);
    return {now[1], -load_ * beyond * std::cos(now[0]), std::cos(now[0]) - gamma * std::sin(now[0]),
            std::sin(now[0]) + gamma * std::cos(now[0])};
  }

  std::vector<State> trace(double curvature) const {
    const auto moved = [](const State& from, const State& rate, double by) {
      State to = from;
      for (int i = 0; i < 4; ++i) to[i] += by * rate[i];
      return to;
    };
    std::vector<State> states{{0, curvature, 0, 0}};
    const double d = 1.0 / steps;
    for (int n = 0; n < steps; ++n) {
      const State& now = states.back();
      const double s = n * d;
      const State k1 = slope(s, now), k2 = slope(s + d / 2, moved(now, k1, d / 2));
      const State k3 = slope(s + d / 2, moved(now, k2, d / 2));
      const State k4 = slope(s + d, moved(now, k3, d));
      State next = now;
      for (int i = 0; i < 4; ++i) next[i] += d / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
      states.push_back(next);
    }
    return states;
  }

  double load_, shear_;
  bool at_end_;
  std::vector<State> states_;
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double h = run.number("height"), L = run.number("length");
    const Elastica exact(run.number("load"), h * h / (L * L), run.text("kind") == "end load");
    const double spacing = run.number("cell") / run.number("ppd"),
                 middle = run.number("below") + h / 2;
    const ParticleFrame end = run.frame();
    double x = 0, y = 0, count = 0;
    std::vector<double> axis_x, axis_y, line_x, line_y;
    for (std::size_t p = 0; p < end.size(); ++p) {
      if (end.X(p)[0] > L - spacing) {  // the last column, its mean is on the axis
        x += end.x(p)[0];
        y += middle - end.x(p)[1];
        count += 1;
      }
      if (std::abs(end.X(p)[1] - middle) > 0.6 * spacing) continue;
      axis_x.push_back(end.x(p)[0]);
      axis_y.push_back(end.x(p)[1] - middle);
    }
    for (int i = 0; i <= 50; ++i) {
      line_x.push_back(exact.at(i / 50.0)[0]);
      line_y.push_back(-exact.at(i / 50.0)[1]);
    }
    const auto tip = exact.at(1 - spacing / 2 / L);
    out.value("drop", y / count, tip[1]);
    out.value("drop error", std::abs(y / count / tip[1] - 1));
    out.value("reach", x / count, tip[0]);
    out.value("shortening", L - spacing / 2 - x / count, L - spacing / 2 - tip[0]);
    out.value("rest", run.history.back().kinetic_energy / run.history.back().elastic_energy);
    out.figure("Axis of the beam", "x (m)", "y (m)")
        .particles(axis_x, axis_y)
        .exact(line_x, line_y);
  }
};

}  // namespace scree::verify::cases::elastica
