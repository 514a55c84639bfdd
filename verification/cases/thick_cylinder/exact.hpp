// SPDX-License-Identifier: Apache-2.0
//
// Thick-walled cylinder, radii a = 1 m and b = 2 m, inner pressure p, plane strain (Lame 1852; S.
// P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28): with A = p a^2/(b^2 - a^2)
//   sigma_rr = A (1 - b^2/r^2),   sigma_tt = A (1 + b^2/r^2),
//   u_r = (1 + nu)/E A ((1 - 2 nu) r + b^2/r).
// Strains are p/E = 1e-3: what large strain changes is of that share.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::thick_cylinder {

struct Cylinder {
  double pressure, E, nu;
  double A() const { return pressure / 3; }
  double radial(double r) const { return A() * (1 - 4 / (r * r)); }
  double hoop(double r) const { return A() * (1 + 4 / (r * r)); }
  double displacement(double r) const { return (1 + nu) / E * A() * ((1 - 2 * nu) * r + 4 / r); }
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const Cylinder exact{run.number("pressure"), run.number("E"), run.number("nu")};
    const ParticleFrame end = run.frame();
    const Column stress = end.field("stress"), volume = end.field("volume");
    double error = 0, size = 0, off = 0, moved = 0;
    std::vector<double> r_all, radial, hoop, u_all;
    for (std::size_t p = 0; p < end.size(); ++p) {
      const double r = norm(end.X(p)), nx = end.X(p)[0] / r, ny = end.X(p)[1] / r;
      const double xx = stress(p, 0, 0), yy = stress(p, 1, 1), xy = stress(p, 0, 1);
      const double rr = xx * nx * nx + 2 * xy * nx * ny + yy * ny * ny, tt = xx + yy - rr;
      const double u = (end.x(p)[0] - end.X(p)[0]) * nx + (end.x(p)[1] - end.X(p)[1]) * ny;
      r_all.push_back(r);
      radial.push_back(rr / 1e3);
      hoop.push_back(tt / 1e3);
      u_all.push_back(u * 1e3);
      off += std::pow(u - exact.displacement(r), 2) * volume(p);
      moved += std::pow(exact.displacement(r), 2) * volume(p);
      if (r < 1.2 || r > 1.8) continue;  // stairs of the lattice at the edges
      error += (std::pow(rr - exact.radial(r), 2) + std::pow(tt - exact.hoop(r), 2)) * volume(p);
      size += (std::pow(exact.radial(r), 2) + std::pow(exact.hoop(r), 2)) * volume(p);
    }
    out.value("stress error", std::sqrt(error / size));
    out.value("displacement error", std::sqrt(off / moved));
    const HistoryRow& last = run.history.back();
    out.value("rest", last.kinetic_energy / last.elastic_energy);
    draw(exact, r_all, radial, hoop, u_all, out);
  }

 private:
  static void draw(const Cylinder& exact, const std::vector<double>& r,
                   const std::vector<double>& radial, const std::vector<double>& hoop,
                   const std::vector<double>& u, Measured& out) {
    std::vector<double> line, rr, tt, uu;
    for (int i = 0; i <= 50; ++i) {
      line.push_back(1 + i / 50.0);
      rr.push_back(exact.radial(line.back()) / 1e3);
      tt.push_back(exact.hoop(line.back()) / 1e3);
      uu.push_back(exact.displacement(line.back()) * 1e3);
    }
    out.figure("Radial stress", "radius (m)", "stress (kPa)").particles(r, radial).exact(line, rr);
    out.figure("Hoop stress", "radius (m)", "stress (kPa)").particles(r, hoop).exact(line, tt);
    out.figure("Displacement", "radius (m)", "outward (mm)").particles(r, u).exact(line, uu);
  }
};

}  // namespace scree::verify::cases::thick_cylinder
