// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/material.hpp"
#include "materials/pore_water.hpp"
#include "solver/base/tensor.hpp"
#include "solver/step/pass_data.hpp"
#include "solver/step/state_access.hpp"
#include "solver/step/transfer.hpp"

namespace scree {

template <class G, class V, int D>
SCREE_FN void load_position(const G& g, const typename G::Batch& b, V (&u)[D]) {
  for (int a = 0; a < D; ++a) u[a] = g.load(b, a);
}

/// 1 for lanes that hold a particle, else 0.
template <class V, class G>
SCREE_FN V live_lanes(const G& g, const typename G::Batch& b) {
  return select(g.active(b), broadcast<V>(1), broadcast<V>(0));
}

template <class G, class V, int D>
SCREE_FN void load_velocity(const G& g, const typename G::Batch& b, const AuxLayout& layout,
                            Motion<V, D>& motion) {
  for (int c = 0; c < D; ++c) motion.velocity[c] = g.load_aux(b, layout.velocity + c);
}

template <class G, class V, int D>
SCREE_FN void load_motion(const G& g, const typename G::Batch& b, const AuxLayout& layout,
                          Motion<V, D>& motion) {
  load_velocity(g, b, layout, motion);
  for (int c = 0; c < D; ++c) {
    for (int a = 0; a < D; ++a) motion.affine[c][a] = g.load_aux(b, layout.affine + c * D + a);
  }
}

template <class G, class V, int D>
SCREE_FN void store_motion(G& g, const typename G::Batch& b, const AuxLayout& layout,
                           const Motion<V, D>& motion) {
  for (int c = 0; c < D; ++c) {
    g.store_aux(b, layout.velocity + c, motion.velocity[c]);
    for (int a = 0; a < D; ++a) g.store_aux(b, layout.affine + c * D + a, motion.affine[c][a]);
  }
}

template <class V, class G>
SCREE_FN Sym3<V> load_stress(const G& g, const typename G::Batch& b, const AuxLayout& layout) {
  const int s = layout.stress;
  return {g.load_aux(b, s),     g.load_aux(b, s + 1), g.load_aux(b, s + 2),
          g.load_aux(b, s + 3), g.load_aux(b, s + 4), g.load_aux(b, s + 5)};
}

template <class V, class G>
SCREE_FN void store_stress(G& g, const typename G::Batch& b, const AuxLayout& layout,
                           const Sym3<V>& tau) {
  const int s = layout.stress;
  g.store_aux(b, s, tau.xx);
  g.store_aux(b, s + 1, tau.xy);
  g.store_aux(b, s + 2, tau.xz);
  g.store_aux(b, s + 3, tau.yy);
  g.store_aux(b, s + 4, tau.yz);
  g.store_aux(b, s + 5, tau.zz);
}

template <class V, int D, class G>
SCREE_FN void store_increment(G& g, const typename G::Batch& b, const AuxLayout& layout,
                              const Mat3<V>& increment) {
  for (int c = 0; c < D; ++c) {
    for (int a = 0; a < D; ++a) g.store_aux(b, layout.increment + c * D + a, increment(c, a));
  }
}

/// Impulse of the Kirchhoff stress over the next step; no external force.
template <class V, int D, class T>
SCREE_FN Impulse<V, D> make_impulse(const PassParameters<T>& par, const Sym3<V>& tau) {
  Impulse<V, D> impulse;
  for (int c = 0; c < D; ++c) {
    for (int a = 0; a < D; ++a) impulse.stress[c][a] = tau(c, a) * par.impulse_scale;
    impulse.external[c] = broadcast<V>(T(0));
  }
  return impulse;
}

/// The stored external force over the next step, where there is one.
template <class V, int D, class T, class G>
SCREE_FN void add_external(const PassParameters<T>& par, const G& g, const typename G::Batch& b,
                           const AuxLayout& layout, Impulse<V, D>& impulse) {
  if (layout.external < 0) return;
  for (int c = 0; c < D; ++c) {
    impulse.external[c] = g.load_aux(b, layout.external + c) * (par.dt_next * par.particle_mass);
  }
}

/// dt/dx for particles, 0 for padding lanes, which must neither move nor deform.
template <class V, class G, class T>
SCREE_FN V step_over_cell(const G& g, const typename G::Batch& b, const PassParameters<T>& par) {
  return select(g.active(b), broadcast<V>(par.step_over_cell), broadcast<V>(T(0)));
}

/// dt grad v as a 3x3 matrix; in 2D the third row and column vanish (plane strain).
template <class V, int D>
SCREE_FN Mat3<V> gradient_increment(const Motion<V, D>& motion, const V& scale) {
  Mat3<V> increment = zero3<V>();
  for (int c = 0; c < D; ++c) {
    for (int a = 0; a < D; ++a) increment(c, a) = motion.gradient[c][a] * scale;
  }
  return increment;
}

/// Advances the position by way(axis) [cells], reports the motion, checks the movement bound and
/// the domain's faces. farthest(speed): what to report of the way where it is too long.
///
/// Returns 1 for the lanes that may scatter: particles that neither left through an open face nor
/// strayed beyond the arena.
template <class G, class V, int D, class T, class Way, class Farthest>
SCREE_FN V move_particle(G& g, const typename G::Batch& b, const PassParameters<T>& par,
                         const Motion<V, D>& motion, Way&& way, Farthest&& farthest, V (&u)[D]) {
  const V none = broadcast<V>(T(0));
  const MaskOf<V> active = g.active(b);
  V speed = none;
  V stray = none;
  V leaving = none;  // depth beyond an open face [cells], > 0 outside
  V beyond = none;   // the same for closed faces
  for (int a = 0; a < D; ++a) {
    const V moved = u[a] + way(a);  // padding stays where it is
    speed = max(speed, abs(motion.transport[a]));
    stray = max(stray, max(T(home_begin) - moved, moved - T(home_end)));
    const V x = moved + g.block_origin(a);
    stray = max(stray, max(par.wrap_lower[a] - x, x - par.wrap_upper[a]));
    leaving = max(leaving, max(par.alive_lower[a] - x, x - par.alive_upper[a]));
    beyond = max(beyond, max(par.closed_lower[a] - x, x - par.closed_upper[a]));
    u[a] = moved;
  }
  // Written so that a velocity that is not a number fails the test too.
  const MaskOf<V> finite = speed < broadcast<V>(T(1e30));
  const MaskOf<V> inside = stray <= broadcast<V>(T(max_excursion));
  g.fault(active & !finite, FaultCode::not_finite, speed, u, b);
  g.fault(active & !inside, FaultCode::moved_too_far, farthest(speed), u, b);
  g.fault(active & (beyond > broadcast<V>(T(0))), FaultCode::left_domain, beyond, u, b);
  g.note_motion(active, speed, stray);
  const MaskOf<V> gone = leaving > broadcast<V>(T(0));
  g.remove(active & gone & inside, b);
  const MaskOf<V> scatters = active & finite & inside & !gone;
  for (int a = 0; a < D; ++a) u[a] = select(inside & finite, u[a], broadcast<V>(T(2)));
  return select(scatters, broadcast<V>(T(1)), none);
}

/// The same with the motion of this step.
template <class G, class V, int D, class T>
SCREE_FN V move_particle(G& g, const typename G::Batch& b, const PassParameters<T>& par,
                         const Motion<V, D>& motion, V (&u)[D]) {
  const V scale = step_over_cell<V>(g, b, par);
  return move_particle(
      g, b, par, motion, [&](int a) { return motion.transport[a] * scale; },
      [&](const V& speed) { return speed * par.step_over_cell; }, u);
}

/// Whether bodies of a law may carry pore pressure: laws say so themselves.
template <class Material>
inline constexpr bool effective_stress = [] {
  if constexpr (requires { Material::effective_stress; }) return Material::effective_stress;
  return false;
}();

/// Follows the pore pressure in field `field` over the step, adds its share to the wave speed of
/// the skeleton, and returns it [Pa].
template <class G, class V, class T>
SCREE_FN V follow_pore_water(G& g, const typename G::Batch& b, int field,
                             const PassParameters<T>& par, const Mat3<V>& increment,
                             const V& volume_ratio, V& wave_speed) {
  const V pressure = pore_water::advance(g.load(b, field), par.undrained_bulk_modulus, increment);
  g.store(b, field, pressure);
  wave_speed = pore_water::wave_speed(wave_speed, volume_ratio, par.water_stiffness);
  return pressure;
}

/// Reports a new state: its wave speed, and whether the law can represent it at all. Returns the
/// pore pressure [Pa], 0 where there is none.
template <class Material, class G, class V, int D, class T>
SCREE_FN V report_state(G& g, const typename G::Batch& b, const PassParameters<T>& par,
                        const typename Material::template Params<T>& material,
                        const typename Material::template State<V>& state, const Mat3<V>& increment,
                        const V (&u)[D], const V (&velocity)[D]) {
  using State = typename Material::template State<V>;
  const MaskOf<V> active = g.active(b);
  const MaskOf<V> admissible = Material::admissible(material, state);
  g.fault(active & !admissible, FaultCode::inadmissible_state,
          Material::volume_ratio(material, state), u, b);
  V wave_speed = Material::wave_speed(material, state);
  V pressure = broadcast<V>(T(0));
  if constexpr (effective_stress<Material>) {
    if (par.undrained_bulk_modulus > T(0)) {
      pressure = follow_pore_water(g, b, D + state_entries<State, V>, par, increment,
                                   Material::volume_ratio(material, state), wave_speed);
    }
  }
  V square = velocity[0] * velocity[0];
  for (int c = 1; c < D; ++c) square = square + velocity[c] * velocity[c];
  const V diffusion = diffusion_speed<Material, V, T>(material, state, D, par.cell_size);
  g.note_signal(active, wave_speed + sqrt(square) + diffusion);
  return pressure;
}

/// Loads the material state, applies dt grad v, stores it and returns the Kirchhoff stress [Pa],
/// with the pore pressure where there is one; reports the wave speed and states that the material
/// cannot represent. (A stress that comes last need not wait in registers for the rest.)
template <class Material, class G, class V, int D, class T>
SCREE_FN Sym3<V> update_material(G& g, const typename G::Batch& b, const PassParameters<T>& par,
                                 const typename Material::template Params<T>& material,
                                 const Mat3<V>& increment, const V (&u)[D],
                                 const V (&velocity)[D]) {
  using State = typename Material::template State<V>;
  State state = load_state<State, V>(g, b, D);
  Sym3<V> tau;
  if constexpr (stress_of_state<Material, V, T>) {
    Material::advance(material, state, increment);
  } else {
    tau = Material::kirchhoff(material, state, increment, par.dt);
  }
  store_state<V>(g, b, D, state);
  const V pressure = report_state<Material>(g, b, par, material, state, increment, u, velocity);
  if constexpr (stress_of_state<Material, V, T>) tau = Material::stress(material, state);
  if constexpr (effective_stress<Material>) {
    if (par.undrained_bulk_modulus > T(0)) {
      tau = pore_water::total(tau, Material::volume_ratio(material, state), pressure);
    }
  }
  return tau;
}

}  // namespace scree
