// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/math.hpp"
#include "solver/step/particle_ops.hpp"

/// Bodies of the assumed deformation gradient (volumetric_locking = "fbar"): between g2p and
/// stress, the change of volume in dt grad v is replaced by its mean over the nodes around the
/// particle.
///
/// j = det(I + dt grad v) - 1 goes to the nodes with the particles' present volumes V as weights
/// and comes back as a mean, j_i = sum w V j/sum w V. Weights sum to one on every lattice, so the
/// sum of V j over the particles stays what it was. It is the averaging of Zhao, Jiang, Choo, IJNME
/// 124, 2023, applied to the increment (as the F-bar of Coombs et al., CMAME 333, 2018): what lies
/// in the state already is not averaged again.
namespace scree {

/// The in-plane increment (2D: det of the 2x2 part, since F_33 = 1 in plane strain) [-].
template <class V, int D>
struct VolumeIncrement {
  V gradient[D][D];  ///< dt grad v

  template <class G>
  SCREE_FN void load(const G& g, const typename G::Batch& b, int field) {
    for (int c = 0; c < D; ++c) {
      for (int a = 0; a < D; ++a) gradient[c][a] = g.load_aux(b, field + c * D + a);
    }
  }

  /// det(I + m) - 1 from the invariants of m, with all digits where m is small.
  SCREE_FN V change() const {
    const auto& m = gradient;
    const auto minor = [&](int i, int k) { return m[i][i] * m[k][k] - m[i][k] * m[k][i]; };
    if constexpr (D == 2) {
      return (m[0][0] + m[1][1]) + minor(0, 1);
    } else {
      const V det = m[0][0] * minor(1, 2) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                    m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
      return ((m[0][0] + m[1][1]) + m[2][2]) + ((minor(0, 1) + minor(0, 2)) + minor(1, 2)) + det;
    }
  }

  /// I + m times the D-th root of 1 + x, less I.
  SCREE_FN void scale(const V& x) {
    const V root = expm1(log1p(x) * Scalar<V>(1.0 / D));
    for (int c = 0; c < D; ++c) {
      for (int a = 0; a < D; ++a) gradient[c][a] = gradient[c][a] + root * gradient[c][a];
      gradient[c][c] = gradient[c][c] + root;
    }
  }

  template <class G>
  SCREE_FN void store(G& g, const typename G::Batch& b, int field) const {
    for (int c = 0; c < D; ++c) {
      for (int a = 0; a < D; ++a) g.store_aux(b, field + c * D + a, gradient[c][a]);
    }
  }
};

/// Particles to nodes {V j, 0, 0, V}. ratio: aux field of the volume ratio J, V = J V0.
template <class Kernel, class G, int D, class T>
SCREE_FN void scatter_volumes_block(G& g, const PassData<D, T>& data, int ratio) {
  using V = typename G::V;
  g.clear(0);
  g.sync();
  g.each_batch([&](const typename G::Batch& b) {
    V u[D];
    V q[D];
    V none[D][D];
    load_position(g, b, u);
    VolumeIncrement<V, D> increment;
    increment.load(g, b, data.layout.increment);
    const V volume = select(g.active(b), g.load_aux(b, ratio) * data.parameters.particle_volume,
                            broadcast<V>(T(0)));
    transfer_detail::set_zero(q);
    transfer_detail::set_zero(none);
    q[0] = volume * increment.change();
    g.scatter_affine(0, Kernel::template at<V, D>(u).stencil, q, volume, none, live_lanes<V>(g, b));
  });
  g.sync();
  g.stage_out(0);
}

/// Nodes {mean, ...} to particles: dt grad v with the mean change of volume, and J with it.
template <class Kernel, class G, int D, class T>
SCREE_FN void gather_volumes_block(G& g, const PassData<D, T>& data, int ratio) {
  using V = typename G::V;
  g.stage_in(0);
  g.sync();
  g.each_batch([&](const typename G::Batch& b) {
    const V none = broadcast<V>(T(0));
    V u[D];
    V mean[D];
    V unused[D][D];
    load_position(g, b, u);
    g.gather_affine(0, Kernel::template at<V, D>(u).stencil, mean, unused);
    const V wanted = mean[0] * T(1.0 / Kernel::lattices);
    VolumeIncrement<V, D> increment;
    increment.load(g, b, data.layout.increment);
    const V own = increment.change();
    const V ratio_before = g.load_aux(b, ratio);
    // A particle that turns inside out within a step has no such root.
    const MaskOf<V> active = g.active(b);
    const MaskOf<V> upright = min(own, wanted) > broadcast<V>(T(-1));
    g.fault(active & !upright, FaultCode::inadmissible_state, ratio_before * (T(1) + own), u, b);
    const MaskOf<V> changes = active & upright;
    const V safe = select(changes, own, none);
    increment.scale(select(changes, (wanted - safe) / (T(1) + safe), none));
    increment.store(g, b, data.layout.increment);
    g.store_aux(b, ratio, ratio_before + select(changes, wanted, none) * ratio_before);
  });
}

}  // namespace scree
