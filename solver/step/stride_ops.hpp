// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materials/log_determinant.hpp"
#include "solver/step/particle_ops.hpp"

/// Strides (pore water, fused path): for some steps particles stay where they are, as long as none
/// would move by more than a small share of a cell; their velocities and states go on. Weights,
/// masses of the nodes and all that the pressure's equations are made of are then the same in all
/// of them. Momentum and volume are as exact as in a stride of one step, for one set of weights
/// does both. At its end a particle goes where the displacements of the nodes say, which is where
/// its velocities have led.
namespace scree {

template <class G>
SCREE_FN bool in_stride(const AuxLayout& layout) {
  if constexpr (G::takes_pore_water) return layout.growth >= 0;
  return false;
}

/// What the displacements of the nodes since the stride's start do to a particle.
template <class V, int D>
struct StrideMotion {
  V way[D];           ///< [cells]
  Mat3<V> increment;  ///< their gradient: the sum of dt grad v
};

template <class Kernel, class G, class V, int D, class T>
SCREE_FN StrideMotion<V, D> stride_motion(const G& g, const typename G::Batch& b,
                                          const PassParameters<T>& par, const V (&u)[D]) {
  const auto point = Kernel::template at<V, D>(u);
  const V per_cell = select(g.active(b), broadcast<V>(T(1) / par.cell_size), broadcast<V>(T(0)));
  Motion<V, D> sum;
  transfer_detail::gather_affine<Kernel>(g, 1, point, sum.velocity, sum.affine);
  Kernel::template times_inverse_moment<V, D>(point, sum.affine, sum.gradient);
  StrideMotion<V, D> stride;
  for (int a = 0; a < D; ++a) stride.way[a] = sum.velocity[a] * per_cell;
  stride.increment = gradient_increment(sum, per_cell);
  return stride;
}

/// Checks the motion of a particle that stays; faces and blocks wait for the stride's end. Returns
/// 1 for the lanes that may scatter.
template <class G, class V, int D, class T>
SCREE_FN V check_motion(G& g, const typename G::Batch& b, const PassParameters<T>& par,
                        const Motion<V, D>& motion, const V (&u)[D]) {
  const V none = broadcast<V>(T(0));
  const MaskOf<V> active = g.active(b);
  V speed = none;
  for (int a = 0; a < D; ++a) speed = max(speed, abs(motion.transport[a]));
  // Written so that a velocity that is not a number fails the test too.
  const MaskOf<V> finite = speed < broadcast<V>(T(1e30));
  const V moved = speed * par.step_over_cell;
  const MaskOf<V> near = moved <= broadcast<V>(T(max_excursion));
  g.fault(active & !finite, FaultCode::not_finite, speed, u, b);
  g.fault(active & !near, FaultCode::moved_too_far, moved, u, b);
  g.note_motion(active, speed, none);
  return select(active & finite & near, broadcast<V>(T(1)), none);
}

/// Follows the volume over the step and, where the stride ends, moves the particle and stores what
/// the stride did to it. Returns 1 for the lanes that may scatter.
template <class Kernel, class G, class V, int D, class T>
SCREE_FN V follow_stride(G& g, const typename G::Batch& b, const PassParameters<T>& par,
                         const AuxLayout& layout, const Motion<V, D>& motion,
                         const Mat3<V>& increment, V (&u)[D]) {
  V growth = detail::volume_growth(increment);
  if (!par.begins_stride) {
    const V before = g.load_aux(b, layout.growth);
    growth = before + (before + T(1)) * growth;
  }
  g.store_aux(b, layout.growth, growth);
  const bool records = par.record && layout.gathered >= 0;
  for (int a = 0; a < D && records; ++a) g.store_aux(b, layout.gathered + a, u[a]);
  StrideMotion<V, D> stride;
  if (par.sums_stride()) {
    stride = stride_motion<Kernel>(g, b, par, u);
  } else if (par.ends_stride) {
    const V scale = step_over_cell<V>(g, b, par);
    for (int a = 0; a < D; ++a) stride.way[a] = motion.transport[a] * scale;
    stride.increment = increment;
  }
  if (!par.ends_stride) {
    for (int a = 0; a < D && records; ++a) g.store_aux(b, layout.ahead + a, stride.way[a]);
    return check_motion(g, b, par, motion, u);
  }
  store_increment<V, D>(g, b, layout, stride.increment);
  for (int a = 0; a < D && records; ++a) g.store_aux(b, layout.ahead + a, broadcast<V>(T(0)));
  const V live = move_particle(g, b, par, motion, stride.way, u);
  for (int a = 0; a < D; ++a) g.store(b, a, u[a]);
  return live;
}

/// The weight of the water that the particle has gained since t = 0, over the next step. (Its mass
/// stays.)
template <class V, int D, class T, class G>
SCREE_FN void add_gained_weight(const PassParameters<T>& par, const G& g,
                                const typename G::Batch& b, const AuxLayout& layout,
                                Impulse<V, D>& impulse) {
  if (layout.gained < 0) return;
  const V gained = g.load_aux(b, layout.gained) * (par.dt_next * par.particle_mass);
  for (int c = 0; c < D; ++c) impulse.external[c] = gained * par.gravity_next[c];
}

}  // namespace scree
