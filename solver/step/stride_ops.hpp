// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/step/particle_ops.hpp"

/// Strides (pore water, fused path): for some steps particles stay where they are, as long as none
/// would move by more than a small share of a cell; their velocities and states go on. Weights,
/// masses of the nodes and all that the pressure's equations are made of are then the same in all
/// of them, and momentum is as exact as in a stride of one step, for one set of weights does all of
/// it. At its end a particle goes where the displacements of the nodes say, which is where its
/// velocities have led.
namespace scree {

template <class G, int D, class T>
SCREE_FN bool in_stride(const PassData<D, T>& data) {
  if constexpr (G::takes_pore_water) return data.stride.fields.growth >= 0;
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

/// What the law gets in the last step of a stride: positions have gone through I + S, S the
/// stride's increment, states through the product of I + dt grad v, steps as they were, which for n
/// like steps is S^2 (1 - 1/n)/2 more.
template <class V>
SCREE_FN void take_back_squares(int steps, const Mat3<V>& stride, Mat3<V>& increment) {
  using T = Scalar<V>;
  const T share = T(0.5) * (T(1) - T(1) / T(steps));
  const Mat3<V> square = stride * stride;
  for (int c = 0; c < 3; ++c) {
    for (int a = 0; a < 3; ++a) increment(c, a) = increment(c, a) - square(c, a) * share;
  }
}

/// Checks the velocity of a particle that stays; faces and blocks wait for the stride's end.
/// Returns 1 for the lanes that may scatter.
template <class G, class V, int D>
SCREE_FN V check_velocity(G& g, const typename G::Batch& b, const Motion<V, D>& motion,
                          const V (&u)[D]) {
  using T = Scalar<V>;
  const V none = broadcast<V>(T(0));
  const MaskOf<V> active = g.active(b);
  V speed = none;
  for (int a = 0; a < D; ++a) speed = max(speed, abs(motion.transport[a]));
  // Written so that a velocity that is not a number fails the test too.
  const MaskOf<V> finite = speed < broadcast<V>(T(1e30));
  g.fault(active & !finite, FaultCode::not_finite, speed, u, b);
  g.note_motion(active, speed, none);
  return select(active & finite, broadcast<V>(T(1)), none);
}

/// Relative change of volume since the stride's start.
template <class G, class V, class T>
SCREE_FN void follow_volume(G& g, const typename G::Batch& b, const StrideStep<T>& step, int field,
                            const Mat3<V>& increment) {
  V growth = volume_growth(increment);
  if (!step.begins) {
    const V before = g.load_aux(b, field);
    growth = before + (before + T(1)) * growth;
  }
  g.store_aux(b, field, growth);
}

/// A batch at the end of a stride, before and after.
template <class V, int D>
struct StrideEnd {
  V u[D];             ///< position
  Mat3<V> increment;  ///< dt grad v of the step, for the law
  V live;             ///< 1 for the lanes that may scatter
};

/// Moves the particles of a stride that ends and stores what it did to them; with records, also
/// where they are within one. Seldom called, and not part of the passes' code, which has no
/// registers to spare.
template <class Kernel, class G, class V, int D, class T>
SCREE_RARE void end_or_record(G& g, const typename G::Batch& b, const PassData<D, T>& data,
                              const Motion<V, D>& motion, StrideEnd<V, D>& end) {
  const PassParameters<T>& par = data.parameters;
  const StrideStep<T>& step = data.stride;
  const StrideFields& fields = step.fields;
  const bool records = par.record && fields.gathered >= 0;
  for (int a = 0; a < D && records; ++a) g.store_aux(b, fields.gathered + a, end.u[a]);
  StrideMotion<V, D> stride;
  if (step.sums(par.record)) {
    stride = stride_motion<Kernel>(g, b, par, end.u);
  } else {
    const V scale = step_over_cell<V>(g, b, par);
    for (int a = 0; a < D; ++a) stride.way[a] = motion.transport[a] * scale;
    stride.increment = end.increment;
  }
  for (int a = 0; a < D && records; ++a) {
    g.store_aux(b, fields.ahead + a, step.ends ? broadcast<V>(T(0)) : stride.way[a]);
  }
  if (!step.ends) {
    end.live = check_velocity(g, b, motion, end.u);
    return;
  }
  if (!step.begins) take_back_squares(step.steps, stride.increment, end.increment);
  store_increment<V, D>(g, b, data.layout, stride.increment);
  end.live = move_particle(
      g, b, par, motion, [&](int a) { return stride.way[a]; },
      [&](const V&) {
        V farthest = abs(stride.way[0]);
        for (int a = 1; a < D; ++a) farthest = max(farthest, abs(stride.way[a]));
        return farthest;
      },
      end.u);
  for (int a = 0; a < D; ++a) g.store(b, a, end.u[a]);
}

/// Follows the volume over the step and, where the stride ends, moves the particle and stores what
/// the stride did to it. increment: dt grad v of the step, for the law. Returns 1 for the lanes
/// that may scatter.
template <class Kernel, class G, class V, int D, class T>
SCREE_FN V follow_stride(G& g, const typename G::Batch& b, const PassData<D, T>& data,
                         const Motion<V, D>& motion, Mat3<V>& increment, V (&u)[D]) {
  const StrideStep<T>& step = data.stride;
  V live;
  if (step.ends || data.parameters.record) {
    const Motion<V, D> copy = motion;  // so that the pass keeps its own in registers
    StrideEnd<V, D> end;
    for (int a = 0; a < D; ++a) end.u[a] = u[a];
    end.increment = increment;
    end_or_record<Kernel>(g, b, data, copy, end);
    for (int a = 0; a < D; ++a) u[a] = end.u[a];
    increment = end.increment;
    live = end.live;
  } else {
    live = check_velocity(g, b, motion, u);
  }
  follow_volume(g, b, step, step.fields.growth, increment);
  return live;
}

/// The weight of the water that the particle has gained since t = 0, over the next step. (Its mass
/// stays.)
template <class V, int D, class T, class G>
SCREE_FN void add_gained_weight(const PassData<D, T>& data, const G& g, const typename G::Batch& b,
                                Impulse<V, D>& impulse) {
  const int field = data.stride.fields.gained;
  if (field < 0) return;
  const PassParameters<T>& par = data.parameters;
  const V gained = g.load_aux(b, field) * (par.dt_next * par.particle_mass);
  for (int c = 0; c < D; ++c) impulse.external[c] = gained * data.stride.gravity_next[c];
}

}  // namespace scree
