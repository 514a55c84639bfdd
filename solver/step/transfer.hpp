// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/tensor.hpp"
#include "solver/simulation/method.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// What a particle takes from the grid and carries to it; velocities in m/s, lengths in cells.
template <class V, int D>
struct Motion {
  V velocity[D];     ///< the particle's velocity
  V transport[D];    ///< velocity that moves it (differs from velocity for flip)
  V affine[D][D];    ///< B = 1/2 sum w v (x_i - x_p)^T [m/s cells]
  V gradient[D][D];  ///< velocity gradient [m/s per cell]
};

/// Forces on a particle for one scatter: impulse = dt * force.
template <class V, int D>
struct Impulse {
  V stress[D][D];  ///< -dt V0/dx tau [kg m/s]; times D^-1 or the slopes gives momentum
  V external[D];   ///< dt * external force [kg m/s]
};

namespace transfer_detail {

template <class V, int D>
SCREE_FN void set_zero(V (&a)[D]) {
  for (int i = 0; i < D; ++i) a[i] = broadcast<V>(Scalar<V>(0));
}
template <class V, int D>
SCREE_FN void set_zero(V (&a)[D][D]) {
  for (int i = 0; i < D; ++i) set_zero(a[i]);
}

/// velocity = mean over lattices of sum w v; affine = mean of sum w v (x_i - x_p)^T.
template <class Kernel, class G, class Point, class V, int D>
SCREE_FN void gather_affine(const G& g, int channel, const Point& p, V (&velocity)[D],
                            V (&affine)[D][D]) {
  using T = Scalar<V>;
  g.gather_affine(channel, p.stencil, velocity, affine);
  const T share = T(1.0 / Kernel::lattices);
  for (int c = 0; c < D; ++c) {
    velocity[c] = velocity[c] * share;
    for (int a = 0; a < D; ++a) affine[c][a] = affine[c][a] * share;
  }
}

/// velocity as above; gradient = mean of sum v grad w^T.
template <class Kernel, class G, class Point, class V, int D>
SCREE_FN void gather_gradient(const G& g, int channel, const Point& p, V (&velocity)[D],
                              V (&gradient)[D][D]) {
  using T = Scalar<V>;
  set_zero(velocity);
  set_zero(gradient);
  const auto slopes = Kernel::template slopes<V, D>(p);
  SCREE_UNROLL_ON_DEVICE for (int k = 0; k < Kernel::lattices; ++k) {
    V value[D];
    V part[D][D];
    g.gather_slopes(channel, p.stencil.base[k], p.stencil.weight[k], slopes.slope[k], value, part);
    for (int c = 0; c < D; ++c) {
      velocity[c] = velocity[c] + value[c];
      for (int a = 0; a < D; ++a) gradient[c][a] = gradient[c][a] + part[c][a];
    }
  }
  const T share = T(1.0 / Kernel::lattices);
  for (int c = 0; c < D; ++c) {
    velocity[c] = velocity[c] * share;
    for (int a = 0; a < D; ++a) gradient[c][a] = gradient[c][a] * share;
  }
}

/// Scatters sum_k w q + f grad w and the mass.
template <class Kernel, class G, class Point, class V, int D>
SCREE_FN void scatter_gradient(G& g, int channel, const Point& p, const V (&q)[D], const V& mass,
                               const V (&f)[D][D], const V& mask) {
  const auto slopes = Kernel::template slopes<V, D>(p);
  SCREE_UNROLL_ON_DEVICE for (int k = 0; k < Kernel::lattices; ++k) {
    g.scatter_slopes(channel, p.stencil.base[k], p.stencil.weight[k], slopes.slope[k], q, mass, f,
                     mask);
  }
}

template <class V, int D>
SCREE_FN void scaled(const V (&a)[D], Scalar<V> s, V (&out)[D]) {
  for (int c = 0; c < D; ++c) out[c] = a[c] * s;
}

}  // namespace transfer_detail

/// Moving-least-squares MPM: affine momentum and MLS force through one matrix,
/// A = (m B - dt V0 tau) D^-1 (Hu et al., ACM TOG 37(4), 2018; CK-MPM eq. 15, 20, 21).
template <class Kernel>
struct Mls {
  static constexpr bool carries_affine = true;
  static constexpr bool reads_increment = false;

  template <class G, class Point, class V, int D>
  SCREE_FN static void gather(const G& g, const Point& p, Scalar<V>, Motion<V, D>& m) {
    transfer_detail::gather_affine<Kernel>(g, 0, p, m.velocity, m.affine);
    Kernel::template times_inverse_moment<V, D>(p, m.affine, m.gradient);
    for (int c = 0; c < D; ++c) m.transport[c] = m.velocity[c];
  }

  template <class G, class Point, class V, int D>
  SCREE_FN static void scatter(G& g, const Point& p, Scalar<V> mass, const Motion<V, D>& m,
                               const Impulse<V, D>& impulse, bool separate, const V& mask) {
    using T = Scalar<V>;
    V q[D];
    V sum[D][D];
    V a[D][D];
    for (int c = 0; c < D; ++c) {
      q[c] = m.velocity[c] * mass;
      if (!separate) q[c] = q[c] + impulse.external[c];
      for (int b = 0; b < D; ++b) {
        sum[c][b] = m.affine[c][b] * mass;
        if (!separate) sum[c][b] = sum[c][b] + impulse.stress[c][b];
      }
    }
    Kernel::template times_inverse_moment<V, D>(p, sum, a);
    g.scatter_affine(0, p.stencil, q, broadcast<V>(mass), a, mask);
    if (!separate) return;
    Kernel::template times_inverse_moment<V, D>(p, impulse.stress, a);
    g.scatter_affine(1, p.stencil, impulse.external, broadcast<V>(T(0)), a, mask);
  }
};

/// Affine particle-in-cell: affine momentum as in mls, gradient-form force and velocity gradient
/// (Jiang et al., ACM TOG 34(4), 2015).
template <class Kernel>
struct Apic {
  static constexpr bool carries_affine = true;
  static constexpr bool reads_increment = false;

  template <class G, class Point, class V, int D>
  SCREE_FN static void gather(const G& g, const Point& p, Scalar<V>, Motion<V, D>& m) {
    transfer_detail::gather_affine<Kernel>(g, 0, p, m.velocity, m.affine);
    transfer_detail::gather_gradient<Kernel>(g, 0, p, m.transport, m.gradient);
    for (int c = 0; c < D; ++c) m.transport[c] = m.velocity[c];
  }

  template <class G, class Point, class V, int D>
  SCREE_FN static void scatter(G& g, const Point& p, Scalar<V> mass, const Motion<V, D>& m,
                               const Impulse<V, D>& impulse, bool separate, const V& mask) {
    using T = Scalar<V>;
    V q[D];
    V sum[D][D];
    V a[D][D];
    transfer_detail::scaled(m.velocity, mass, q);
    for (int c = 0; c < D; ++c) transfer_detail::scaled(m.affine[c], mass, sum[c]);
    Kernel::template times_inverse_moment<V, D>(p, sum, a);
    g.scatter_affine(0, p.stencil, q, broadcast<V>(mass), a, mask);
    transfer_detail::scatter_gradient<Kernel>(g, separate ? 1 : 0, p, impulse.external,
                                              broadcast<V>(T(0)), impulse.stress, mask);
  }
};

/// Particle-in-cell (blend 0) and FLIP (blend 1) with gradient-form force and velocity gradient:
/// v <- blend (v + dv) + (1 - blend) v_pic, dv interpolated from the grid's velocity change
/// (Brackbill, Ruppel, JCP 65, 1986).
template <class Kernel, bool flip>
struct Pic {
  static constexpr bool carries_affine = false;
  static constexpr bool reads_increment = flip;

  template <class G, class Point, class V, int D>
  SCREE_FN static void gather(const G& g, const Point& p, Scalar<V> blend, Motion<V, D>& m) {
    using T = Scalar<V>;
    transfer_detail::set_zero(m.affine);
    transfer_detail::gather_gradient<Kernel>(g, 0, p, m.transport, m.gradient);
    if constexpr (flip) {
      V increment[D];
      V unused[D][D];
      transfer_detail::gather_gradient<Kernel>(g, 1, p, increment, unused);
      for (int c = 0; c < D; ++c) {
        m.velocity[c] = (m.velocity[c] + increment[c]) * blend + m.transport[c] * (T(1) - blend);
      }
    } else {
      (void)blend;
      for (int c = 0; c < D; ++c) m.velocity[c] = m.transport[c];
    }
  }

  template <class G, class Point, class V, int D>
  SCREE_FN static void scatter(G& g, const Point& p, Scalar<V> mass, const Motion<V, D>& m,
                               const Impulse<V, D>& impulse, bool separate, const V& mask) {
    using T = Scalar<V>;
    V q[D];
    for (int c = 0; c < D; ++c) {
      q[c] = m.velocity[c] * mass;
      if (!separate) q[c] = q[c] + impulse.external[c];
    }
    if (!separate) {
      transfer_detail::scatter_gradient<Kernel>(g, 0, p, q, broadcast<V>(mass), impulse.stress,
                                                mask);
      return;
    }
    V none[D][D];
    transfer_detail::set_zero(none);
    g.scatter_affine(0, p.stencil, q, broadcast<V>(mass), none, mask);
    transfer_detail::scatter_gradient<Kernel>(g, 1, p, impulse.external, broadcast<V>(T(0)),
                                              impulse.stress, mask);
  }
};

}  // namespace scree
