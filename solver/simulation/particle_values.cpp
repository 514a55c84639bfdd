// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/particle_values.hpp"

#include <algorithm>

#include "solver/base/stress_invariants.hpp"

namespace scree {
namespace {

/// Cauchy stress is Kirchhoff stress over J; `pore_pressure` is added to its diagonal.
Sym3<double> cauchy(const ParticleView& p, double pore_pressure) {
  const auto& k = p.kirchhoff;
  const double J = p.volume_ratio;
  return {k[0] / J + pore_pressure, k[1] / J, k[2] / J,
          k[3] / J + pore_pressure, k[4] / J, k[5] / J + pore_pressure};
}

void write_tensor(const Sym3<double>& s, double* out) {
  const double six[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
  for (int i = 0; i < 9; ++i) out[i] = six[sym_index[i]];
}

/// What follows from the effective stress.
void write_stress_quantity(FieldQuantity quantity, const ParticleView& p, double* out) {
  const Sym3<double> stress = cauchy(p, p.pore_pressure.value_or(0));
  if (quantity == FieldQuantity::p) out[0] = mean_pressure(stress);
  if (quantity == FieldQuantity::q) out[0] = deviatoric_stress(stress);
  if (quantity == FieldQuantity::p || quantity == FieldQuantity::q) return;
  const PrincipalStress principal = principal_stress(stress);
  if (quantity == FieldQuantity::lode_angle) out[0] = lode_angle(principal.value);
  if (quantity == FieldQuantity::mobilised_friction) out[0] = mobilised_friction(principal.value);
  for (std::size_t i = 0; i < 3; ++i) {
    if (quantity == FieldQuantity::principal_stress) out[i] = principal.value[i];
    if (quantity != FieldQuantity::principal_directions) continue;
    std::copy(principal.direction[i].begin(), principal.direction[i].end(), out + 3 * i);
  }
}

}  // namespace

void write_quantity(FieldQuantity quantity, const ParticleView& p, const BodyInfo& info,
                    const double* reference, double* out) {
  switch (quantity) {
    case FieldQuantity::velocity:
      std::copy(p.velocity.begin(), p.velocity.end(), out);
      return;
    case FieldQuantity::stress:
      return write_tensor(cauchy(p, 0), out);
    case FieldQuantity::effective_stress:
      if (p.pore_pressure) write_tensor(cauchy(p, *p.pore_pressure), out);
      return;
    case FieldQuantity::pressure:
      out[0] = mean_pressure(cauchy(p, 0));
      return;
    case FieldQuantity::p:
    case FieldQuantity::q:
    case FieldQuantity::lode_angle:
    case FieldQuantity::principal_stress:
    case FieldQuantity::principal_directions:
    case FieldQuantity::mobilised_friction:
      return write_stress_quantity(quantity, p, out);
    case FieldQuantity::mass:
      out[0] = info.particle_mass();
      return;
    case FieldQuantity::volume:
      out[0] = info.particle_volume * p.volume_ratio;
      return;
    case FieldQuantity::volume_ratio:
      out[0] = p.volume_ratio;
      return;
    case FieldQuantity::displacement:
      for (int a = 0; a < 3; ++a) out[a] = p.position[std::size_t(a)] - reference[a];
      return;
    case FieldQuantity::yield_distance:
    case FieldQuantity::equivalent_plastic_shear_strain:
    case FieldQuantity::strain_rate:
    case FieldQuantity::state:
      return;
  }
}

}  // namespace scree
