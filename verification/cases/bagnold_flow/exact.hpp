// SPDX-License-Identifier: Apache-2.0
//
// Steady uniform flow of a layer of grains (mu(I) rheology) of depth h down a rough plane inclined
// by theta, P. Jop, Y. Forterre, O. Pouliquen, Nature 441, 2006. Along and across the slope
// tau/p = tan(theta) at every depth, so mu(I) = tan(theta) and
//   I = I_t = i0 (tan(theta) - mu_s)/(mu_2 - tan(theta)) = (du/dy) d/sqrt(p/rho_s).
// With p = phi rho_s g cos(theta) (h - y), the velocity is Bagnold's profile
//   u(y) = 2/3 (I_t/d) sqrt(phi g cos(theta)) (h^1.5 - (h - y)^1.5).
// Deviations of the velocity diffuse with the tangent viscosity d tau/d(du/dy) = p I
// mu'(I)/(du/dy), 0.7 Pa s at 24 deg, a tenth of tau/(du/dy); they decay in 4 rho h^2/(pi^2 0.7 Pa
// s) = 2 s. The layer starts with 0.95 of the profile, so after twice that 0.7 % are left.
//
// Below the angle of friction the layer stops. Where it shears, tau >= mu_s p; where it moves as a
// whole, tau = mu_s p over the depth is a stress that it may have, and with it the speed
//   w(t) = max(w(0) - a t, 0),   a = g cos(theta) (mu_s - tan(theta)),
// solves the equation of motion above a base that is no faster. Viscous flow between p and the rate
// of shear is monotone, so that two solutions keep their order: a layer whose first speeds are at
// most w(0) is nowhere faster than w(t), and at rest at w(0)/a. The elastic strain of the stress
// above the weight's, (mu_s - tan(theta)) p at most, is then set free: the layer swings with speeds
// up to that stress at the base over the impedance of shear, rho c_s = sqrt(rho G).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::bagnold_flow {

struct Case {
  static void measure(const Run& run, Measured& out) {
    if (std::tan(run.number("theta")) < run.number("mu_s")) {
      measure_stop(run, out);
    } else {
      measure_flow(run, out);
    }
  }

 private:
  static void measure_flow(const Run& run, Measured& out) {
    const double h = run.number("depth"), rate = run.number("rate");
    const double weight = run.number("density") * run.number("g") * std::cos(run.number("theta"));
    const auto exact = [&](double y) {
      return rate * (std::pow(h, 1.5) - std::pow(std::max(h - y, 0.0), 1.5));
    };
    const ParticleFrame end = run.frame();
    const Column velocity = end.field("velocity"), volume = end.field("volume");
    const Column pressure = end.field("pressure");
    double off = 0, total = 0, weighted = 0, all = 0;
    std::vector<double> y, u, kilopascals;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double here = end.x(p)[1], speed = velocity(p, 0);
      off += (speed - exact(here)) * (speed - exact(here)) * volume(p);
      total += exact(here) * exact(here) * volume(p);
      weighted += std::abs(pressure(p) - weight * (h - here)) * volume(p);
      all += volume(p);
      y.push_back(here);
      u.push_back(speed);
      kilopascals.push_back(pressure(p) / 1e3);
    }
    out.value("velocity error", std::sqrt(off / total));
    out.value("pressure error", weighted / (weight * h * all));
    const std::size_t rows = run.history.size();
    const auto mean = [&](std::size_t i) {
      return run.history[i].momentum[0] / run.history[i].mass;
    };
    out.value("mean velocity", mean(rows - 1), 0.6 * exact(h));
    out.value("change", std::abs(mean(rows - 1) / mean(rows - 1 - rows / 5) - 1));
    std::vector<double> line, profile;
    for (int i = 0; i <= 50; ++i) {
      line.push_back(h * i / 50);
      profile.push_back(exact(line.back()));
    }
    out.figure("Velocity", "height above the plane (m)", "velocity (m/s)")
        .particles(y, u)
        .exact(line, profile);
    out.figure("Pressure", "height above the plane (m)", "pressure (kPa)")
        .particles(y, kilopascals)
        .exact({0, h}, {weight * h / 1e3, 0});
  }

  /// All speeds in those of the surface at the start.
  static void measure_stop(const Run& run, Measured& out) {
    const double theta = run.number("theta"), excess = run.number("mu_s") - std::tan(theta);
    const double weight = run.number("density") * run.number("g") * std::cos(theta);
    const double first = run.number("slowed"), a = run.number("g") * std::cos(theta) * excess;
    const double G = run.number("E") / (2 * (1 + run.number("nu")));
    const double swing =
        excess * weight * run.number("depth") / std::sqrt(run.number("density") * G);
    std::vector<double> t, fastest, bound;
    double ahead = 0;
    for (int f = 0; f < static_cast<int>(run.frames.size()); ++f) {
      const ParticleFrame frame = run.frame(f);
      const Column velocity = frame.field("velocity");
      double speed = 0;
      for (std::size_t p = 0; p < frame.size(); ++p)
        speed = std::max(speed, std::abs(velocity(p, 0)));
      t.push_back(frame.time());
      fastest.push_back(speed / first);
      bound.push_back(std::max(1 - a * frame.time() / first, 0.0));
      ahead = std::max(ahead, (speed - swing) / first - bound.back());
    }
    out.value("ahead of the bound", ahead);
    out.value("speed at the end", fastest.back() * first / swing);
    // After the last time at which it could move: the second half, or less.
    const auto from = static_cast<std::size_t>(first / a / run.number("end") *
                                               static_cast<double>(run.history.size() - 1));
    double sum = 0, count = 0;
    for (std::size_t i = from + 1; i < run.history.size(); ++i, ++count)
      sum += run.history[i].momentum[0] / run.history[i].mass;
    out.value("mean velocity at rest", std::abs(sum / count) / first);
    // At the start, while all of it flows: momentum that was lost over time and weight.
    const HistoryRow& early = run.history.at(1);
    const double lost = (run.history[0].momentum[0] - early.momentum[0]) / early.mass;
    out.value("friction at the base",
              std::tan(theta) + lost / (run.number("g") * std::cos(theta) * early.time));
    out.figure("A layer that stops", "time (s)", "largest speed over the first")
        .computed(t, fastest)
        .exact(t, bound);
  }
};

}  // namespace scree::verify::cases::bagnold_flow
