// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "verification/conformance/checks.hpp"

namespace scree::testing {

Worst energy_derivative(const Law& law, MatrixSource& source, int count) {
  const double h = 1e-5;
  const int slid = law.first_entry("equivalent_plastic_strain");
  Worst worst;
  for (int n = 0; n < count; ++n) {
    const auto state = elastic_state(law, source);
    if (!state) continue;
    const Eigen::Matrix3d direction = source.entries(1);
    bool elastic = true;
    const auto energy = [&](double step) {
      State moved = *state;
      advance(law, moved, step * direction, 1.0);
      const auto yield = law.exact->yield_value(moved);
      if (yield && *yield > -1e-6) elastic = false;
      if (slid >= 0 && moved[std::size_t(slid)] != (*state)[std::size_t(slid)]) elastic = false;
      return law.exact->energy_density(moved);
    };
    const double slope = (energy(h) - energy(-h)) / (2 * h);
    if (!elastic) continue;
    const Sym3<double> tau = stress_at_rest(law, *state);
    const double power = (to_eigen(tau) * direction).trace();
    worst.add(std::abs(slope - power) / stress_scale(law, *state, tau));
  }
  return worst;
}

Dissipation dissipation(const Law& law, MatrixSource& source, int paths) {
  Dissipation result{1e300, -1e300};
  for (int n = 0; n < paths; ++n) {
    State state = law.exact->initial();
    const double compression = std::pow(10, source.uniform(-4, -1.5));
    advance(law, state, -compression * Eigen::Matrix3d::Identity());
    Sym3<double> last = law.exact->kirchhoff(state, zero3<double>(), 1.0);
    const double before = law.exact->energy_density(state);
    double work = 0, scale = law.stiffness;
    follow(law, state, loop(source, 0.02), 400,
           [&](const Eigen::Matrix3d& L, const Sym3<double>& now) {
             // Midpoint rate: the error of a step is of third order in L.
             const Eigen::Matrix3d rate = L * (Eigen::Matrix3d::Identity() + 0.5 * L).inverse();
             work += 0.5 * ((to_eigen(last) + to_eigen(now)) * rate).trace();
             scale = std::max(scale, norm(now));
             last = now;
           });
    const double lost = (work - law.exact->energy_density(state) + before) / scale;
    result.least = std::min(result.least, lost);
    result.most = std::max(result.most, lost);
  }
  return result;
}

namespace {

/// Of modified Cam clay at its start: K = v p/kappa with v on the swelling line of pc, G by nu.
LameConstants clay_moduli(const Family& family, const std::any& input, double kappa) {
  const auto key = [&](const char* name) { return family.number(input, name).value(); };
  const double p = key("initial_pressure"), nu = key("poissons_ratio");
  const auto ocr = family.number(input, "ocr");
  const double pc = ocr ? *ocr * p : key("preconsolidation_pressure");
  const double v = 1 + key("reference_void_ratio") - key("lambda") * std::log(pc / 1e3) +
                   kappa * std::log(pc / p);
  const double bulk = v * p / kappa;
  return {3 * nu / (1 + nu) * bulk, 1.5 * (1 - 2 * nu) / (1 + nu) * bulk};
}

/// Lame constants at small strain, where the keys of the input tell them.
std::optional<LameConstants> linear_moduli(const Family& family, const std::any& input) {
  if (const auto kappa = family.number(input, "kappa")) return clay_moduli(family, input, *kappa);
  const auto E = family.number(input, "youngs_modulus");
  const auto nu = family.number(input, "poissons_ratio");
  if (E && nu) return lame_constants(*E, *nu);
  const auto bulk = family.number(input, "bulk_modulus");
  if (!bulk) return std::nullopt;
  // The key of j_fluid is the prefactor B of the pressure.
  const double factor = family.name == "j_fluid" ? family.number(input, "gamma").value_or(1) : 1;
  return LameConstants{*bulk * factor, 0};
}

}  // namespace

Worst small_strain(const Family& family, const std::any& input, MatrixSource& source, int count) {
  Worst worst;
  const auto moduli = linear_moduli(family, input);
  const Law law = family.make(input);
  if (!moduli) return worst;
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d start = to_eigen(stress_at_rest(law, law.exact->initial()));
  // Compression is inside every cone. Clay under stress may be about to yield in it, so it swells.
  // Of other laws that start under stress the moduli there are not known.
  const bool stressed = start.norm() > 0;
  if (stressed && !family.number(input, "kappa")) return worst;
  const double size = 1e-5, sign = stressed ? 1 : -1;
  for (int n = 0; n < count; ++n) {
    const Eigen::Matrix3d L = size * (0.1 * source.entries(1) + sign * one);
    State state = law.exact->initial();
    advance(law, state, L, 1.0);
    const Eigen::Matrix3d strain = 0.5 * (L + L.transpose());
    // The Kirchhoff stress J sigma also grows with the volume.
    const Eigen::Matrix3d linear = (1 + strain.trace()) * start + 2 * moduli->mu * strain +
                                   moduli->lambda * strain.trace() * one;
    const double error = (to_eigen(stress_at_rest(law, state)) - linear).norm();
    worst.add(error / (size * size * law.stiffness));
  }
  return worst;
}

}  // namespace scree::testing
