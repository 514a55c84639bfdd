// SPDX-License-Identifier: Apache-2.0
/// \file
/// The point functions that are the same for all laws whose elasticity is Hencky's.
#pragma once

#include "materials/hencky_elasticity.hpp"

namespace scree {

/// Base of laws with the parameters lambda, mu and density, and with F (the elastic part) and
/// log_volume_ratio in the state. P: the law's Params, S: its State.
struct HenckySolid {
  static constexpr bool long_chains = true;

  /// Of elasticity, which bounds associated flow too. Laws whose flow may be stiffer than that have
  /// a wave_speed of their own.
  template <class P, class S>
  SCREE_FN static auto wave_speed(const P& p, const S& s) {
    using T = decltype(P::lambda);
    const auto stiffness = detail::hencky_stiffness(p.lambda, p.mu, detail::strain_bounds(s.F));
    return sqrt(stiffness * (T(1) / p.density));
  }

  template <class P, class S>
  SCREE_FN static auto energy_density(const P& p, const S& s) {
    return detail::hencky_energy(p.lambda, p.mu, s.F);
  }

  template <class P, class S>
  SCREE_FN static auto volume_ratio(const P&, const S& s) {
    return exp(s.log_volume_ratio);
  }

  template <class P, class S>
  SCREE_FN static auto admissible(const P&, const S& s) {
    return det(s.F) > detail::PolarLimits<decltype(P::lambda)>::det_min;
  }
};

}  // namespace scree
