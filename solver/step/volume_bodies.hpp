// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/math.hpp"
#include "solver/base/tensor.hpp"
#include "solver/step/particle_ops.hpp"
#include "solver/step/state_access.hpp"
#include "solver/step/volume_passes.hpp"

/// Bodies of the assumed deformation gradient (volumetric_locking = "fbar"): between g2p and
/// stress, the change of volume in dt grad v is replaced by its mean over the nodes around the
/// particle.
///
/// S q = sum w (sum w V q/sum w V), mean over the lattices, with the particles' present volumes V.
/// It is the averaging of Zhao, Jiang, Choo, IJNME 124, 2023, applied to the increments (as the
/// F-bar of Coombs et al., CMAME 333, 2018): j = det(I + dt grad v) - 1 becomes d + S(j - d).
///
/// d is the plastic change of volume of the step before. Only the elastic change makes pressure,
/// and only that is averaged: dilation differs from particle to particle in a shear band, and were
/// each given the mean instead of its own, its pressure would rise without end. The plastic change
/// of this step is not known before the law has been asked; what the delay leaves in the elastic
/// volume is the difference of two steps' d and does not add up. Grains out of contact (J_e >= 1)
/// get the mean: their own d would go on by itself.
///
/// What lies in the states already is averaged as far as the material is sheared, since particles
/// from different places meet: a (S(a s) - s S(a)) comes on top, with s = ln J_e and a^2 four times
/// the shear strain of the step. At rest it is nothing.
///
/// Weights sum to one on every lattice and V S is symmetric, so the sum of V j over the particles
/// stays what it was, with either part.
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

  /// Shear strain in the plane or space: of simple shear, the angle [-].
  SCREE_FN V shear() const {
    const auto& m = gradient;
    V square = broadcast<V>(Scalar<V>(0));
    for (int c = 0; c < D; ++c) {
      for (int a = 0; a < c; ++a) {
        const V twist = m[c][a] + m[a][c], stretch = m[c][c] - m[a][a];
        square = square + twist * twist + stretch * stretch * Scalar<V>(2.0 / D);
      }
    }
    return sqrt(square);
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

/// Volumes of particles before the step.
template <class V>
struct ParticleVolume {
  V ratio;    ///< J
  V strain;   ///< s = ln J_e
  V plastic;  ///< ln(J/J_e)
  V flow;     ///< d, the plastic change of the step before; 0 for grains out of contact

  template <class G>
  SCREE_FN static ParticleVolume load(const G& g, const typename G::Batch& b,
                                      const VolumeFields& fields) {
    const MaskOf<V> active = g.active(b);
    const V none = broadcast<V>(0), one = broadcast<V>(1);
    const V J = select(active, g.load_aux(b, fields.ratio), one);
    if (fields.gradient < 0) return {J, log(J), none, none};
    const Mat3<V> F = load_state<Mat3<V>, V>(g, b, fields.gradient);
    const V elastic = log(max(select(active, det(F), one), broadcast<V>(least_ratio)));
    const V plastic = log(J) - elastic;
    const V before = select(active, g.load_aux(b, fields.plastic), none);
    return {J, elastic, plastic, select(elastic < none, plastic - before, none)};
  }

  /// Of J_e in the logarithm: what is below ends the run by itself (inadmissible_state).
  static constexpr Scalar<V> least_ratio = Scalar<V>(1e-6);
};

/// What a particle gives to S, and what S gives it.
template <class V>
struct VolumeMeans {
  V change;  ///< j - d
  V strain;  ///< a s
  V share;   ///< a
};

/// a^2 = four times the shear strain of the step, as far as that is less than one: differences fade
/// to a fiftieth while neighbours change. (One time lets pressures of a breaking dam scatter twice
/// as much, sixteen times are no better than four.)
template <class V, int D>
SCREE_FN V mixing(const VolumeIncrement<V, D>& increment) {
  return sqrt(min(increment.shear() * Scalar<V>(4), broadcast<V>(Scalar<V>(1))));
}

/// Particles to nodes; V = J V0.
template <class Kernel, class G, int D, class T>
SCREE_FN void scatter_volumes_block(G& g, const PassData<D, T>& data, const VolumeFields& fields) {
  using V = typename G::V;
  for (int c = 0; c < volume_channels<D>; ++c) g.clear(c);
  g.sync();
  g.each_batch([&](const typename G::Batch& b) {
    const MaskOf<V> active = g.active(b);
    V u[D];
    V none[D][D];
    load_position(g, b, u);
    transfer_detail::set_zero(none);
    VolumeIncrement<V, D> increment;
    increment.load(g, b, data.layout.increment);
    const auto here = ParticleVolume<V>::load(g, b, fields);
    const V volume =
        select(active, here.ratio * data.parameters.particle_volume, broadcast<V>(T(0)));
    const V share = mixing(increment);
    const VolumeMeans<V> own{increment.change() - here.flow, share * here.strain, share};
    const auto point = Kernel::template at<V, D>(u);
    const V live = live_lanes<V>(g, b);
    V q[D];
    q[0] = volume * own.change;
    q[1] = volume * own.strain;
    if constexpr (D == 3) q[2] = volume * own.share;
    g.scatter_affine(0, point.stencil, q, volume, none, live);
    if constexpr (D == 3) return;
    q[0] = volume * own.share;
    q[1] = broadcast<V>(T(0));
    g.scatter_affine(1, point.stencil, q, volume, none, live);
  });
  g.sync();
  for (int c = 0; c < volume_channels<D>; ++c) g.stage_out(c);
}

/// S of the three at a particle.
template <class Kernel, class V, int D, class G>
SCREE_FN VolumeMeans<V> gather_means(const G& g, const V (&u)[D]) {
  using T = Scalar<V>;
  const auto point = Kernel::template at<V, D>(u);
  const T part = T(1.0 / Kernel::lattices);
  V mean[D];
  V unused[D][D];
  g.gather_affine(0, point.stencil, mean, unused);
  VolumeMeans<V> means{mean[0] * part, mean[1] * part, broadcast<V>(T(0))};
  if constexpr (D == 2) {
    g.gather_affine(1, point.stencil, mean, unused);
    means.share = mean[0] * part;
  } else {
    means.share = mean[2] * part;
  }
  return means;
}

/// Nodes to particles: dt grad v with the mean change of volume, and J with it.
template <class Kernel, class G, int D, class T>
SCREE_FN void gather_volumes_block(G& g, const PassData<D, T>& data, const VolumeFields& fields) {
  using V = typename G::V;
  for (int c = 0; c < volume_channels<D>; ++c) g.stage_in(c);
  g.sync();
  g.each_batch([&](const typename G::Batch& b) {
    const V none = broadcast<V>(T(0));
    const MaskOf<V> active = g.active(b);
    V u[D];
    load_position(g, b, u);
    VolumeIncrement<V, D> increment;
    increment.load(g, b, data.layout.increment);
    const auto here = ParticleVolume<V>::load(g, b, fields);
    const VolumeMeans<V> mean = gather_means<Kernel>(g, u);
    const V wanted =
        here.flow + mean.change + mixing(increment) * (mean.strain - here.strain * mean.share);
    const V own = increment.change();
    // A particle that turns inside out within a step has no such root.
    const MaskOf<V> upright = min(own, wanted) > broadcast<V>(T(-1));
    g.fault(active & !upright, FaultCode::inadmissible_state, here.ratio * (T(1) + own), u, b);
    const MaskOf<V> changes = active & upright;
    const V safe = select(changes, own, none);
    increment.scale(select(changes, (wanted - safe) / (T(1) + safe), none));
    increment.store(g, b, data.layout.increment);
    g.store_aux(b, fields.ratio, here.ratio + select(changes, wanted, none) * here.ratio);
    g.store_aux(b, fields.plastic, here.plastic);
  });
}

}  // namespace scree
