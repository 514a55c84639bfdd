// SPDX-License-Identifier: Apache-2.0
//
// Modified Cam clay in triaxial compression (K. H. Roscoe, J. B. Burland, 1968; D. Muir Wood, Soil
// Behaviour and Critical State Soil Mechanics, 1990, ch. 5). With eta = q/p', Lambda = (lambda -
// kappa)/lambda and v = 1 + e, the states of normally consolidated clay lie on
//   v = N - lambda ln p' - (lambda - kappa) ln(1 + eta^2/M^2),        p' in kPa, N = v at 1 kPa.
// Undrained, v is constant: p'/p0' = (M^2/(M^2 + eta^2))^Lambda. Drained, p' = p0' + q/3. Critical
// states: q = M p', undrained p' = p0' (R/2)^Lambda for an overconsolidation ratio R, drained
// p' = 3 p0'/(3 - M). Critical states are approached exponentially with the strain.
//
// The shear strain of the undrained path follows from the flow rule, d eps_v^p/d eps_q^p = (M^2 -
// eta^2)/(2 eta), and elasticity, K = v p'/kappa and G = 3 K (1 - 2 nu)/(2 (1 + nu)):
//   v eps = kappa Lambda/M (ln((M + eta)/(M - eta)) - 2 atan(eta/M))
//           + 2 kappa (1 + nu)/(9 (1 - 2 nu)) (eta - 2 Lambda (eta - M atan(eta/M))).
// At constant volume it is the axial logarithmic strain.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify::cases::clay_triaxial {

/// Axial strain of normally consolidated clay on the undrained path.
struct UndrainedStrain {
  double M, kappa, Lambda, nu, v;

  double at(double eta) const {
    const double angle = std::atan(eta / M);
    const double plastic = kappa * Lambda / M * (std::log((M + eta) / (M - eta)) - 2 * angle);
    const double shear = 2 * kappa * (1 + nu) / (9 * (1 - 2 * nu));
    return (plastic + shear * (eta - 2 * Lambda * (eta - M * angle))) / v;
  }
};

struct Case {
  static void measure(const Run& run, Measured& out) {
    const double M = run.number("m"), p0 = run.number("p0"), ocr = run.number("ocr");
    const double lambda = run.number("lambda"), share = 1 - run.number("kappa") / lambda;
    const bool drained = run.text("type") == "triaxial_drained";
    const auto normal = [&](double p, double eta) {
      return 1 + run.number("reference") - lambda * std::log(p / 1e3) -
             lambda * share * std::log(1 + eta * eta / (M * M));
    };
    double surface = 0;
    std::vector<double> strain, p, q, exact_p, exact_q;
    for (const ElementRow& row : run.element->rows) {
      strain.push_back(row.strain.axial);
      p.push_back(row.pressure() / 1e3);
      q.push_back(row.deviatoric() / 1e3);
      const double eta = row.deviatoric() / row.pressure();
      surface = std::max(surface, std::abs(1 + row.void_ratio - normal(row.pressure(), eta)));
    }
    // The specific volume changes by lambda ln 2 between the normal and the critical line.
    if (ocr == 1) out.value("distance to the state surface", surface / (lambda * std::log(2.0)));
    if (ocr == 1 && !drained) measure_strain(run, share, out);
    const double critical = drained ? 3 * p0 / (3 - M) : p0 * std::pow(ocr / 2, share);
    out.value("critical pressure", p.back() * 1e3, critical);
    out.value("strength", q.back() * 1e3, M * critical);
    if (ocr == 1) {
      for (int i = 0; i <= 60; ++i) {
        const double eta = M * i / 60;
        const double here =
            drained ? p0 / (1 - eta / 3) : p0 * std::pow(M * M / (M * M + eta * eta), share);
        exact_p.push_back(here / 1e3);
        exact_q.push_back(eta * here / 1e3);
      }
    } else {
      exact_p = {critical / 1e3};
      exact_q = {M * critical / 1e3};
    }
    out.figure("Stress path", "p' (kPa)", "q (kPa)").computed(p, q).exact(exact_p, exact_q);
    out.figure("Strength", "axial strain", "q (kPa)")
        .computed(strain, q)
        .exact({0, strain.back()}, {M * critical / 1e3, M * critical / 1e3}, "critical state");
  }

 private:
  static void measure_strain(const Run& run, double share, Measured& out) {
    const std::vector<ElementRow>& rows = run.element->rows;
    const double M = run.number("m"), last = 0.9 * M;
    const UndrainedStrain exact{M, run.number("kappa"), share, run.number("nu"),
                                1 + rows.front().void_ratio};
    double error = 0;
    for (const ElementRow& row : rows) {
      const double eta = row.deviatoric() / row.pressure();
      if (eta < last) error = std::max(error, std::abs(row.strain.axial - exact.at(eta)));
    }
    out.value("strain error", error / exact.at(last));
  }
};

}  // namespace scree::verify::cases::clay_triaxial
