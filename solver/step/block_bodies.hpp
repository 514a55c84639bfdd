// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "solver/step/batch_pair.hpp"
#include "solver/step/particle_ops.hpp"
#include "solver/step/stride_ops.hpp"
#include "solver/step/transfer.hpp"

/// The block bodies: the method itself, written once for every backend.
///
/// A body is a list of phases separated by g.sync(). It holds no thread index, atomic or #ifdef; no
/// value survives a sync except in the arena or the particle store.
namespace scree {

/// Particles to grid from the stored velocity, affine matrix and stress (split path, first step).
template <class Kernel, class Transfer, class G, int D, class T>
SCREE_FN void p2g_block(G& g, const PassData<D, T>& data) {
  using V = typename G::V;
  const PassParameters<T>& par = data.parameters;
  g.clear(0);
  if (par.separate_force) g.clear(1);
  g.sync();
  g.each_batch([&](const typename G::Batch& b) {
    V u[D];
    load_position(g, b, u);
    const auto point = Kernel::template at<V, D>(u);
    Motion<V, D> motion;
    load_motion(g, b, data.layout, motion);
    Impulse<V, D> impulse = make_impulse<V, D>(par, load_stress<V>(g, b, data.layout));
    add_external(par, g, b, data.layout, impulse);
    Transfer::scatter(g, point, par.particle_mass, motion, impulse, par.separate_force,
                      live_lanes<V>(g, b));
  });
  g.sync();
  g.stage_out(0);
  if (par.separate_force) g.stage_out(1);
}

/// Grid to particles: velocity, affine matrix, position and dt grad v (split path).
template <class Kernel, class Transfer, class G, int D, class T>
SCREE_FN void g2p_block(G& g, const PassData<D, T>& data) {
  using V = typename G::V;
  const PassParameters<T>& par = data.parameters;
  g.stage_in(0);
  if (Transfer::reads_increment) g.stage_in(1);
  g.sync();
  g.each_batch([&](const typename G::Batch& b) {
    V u[D];
    load_position(g, b, u);
    const auto point = Kernel::template at<V, D>(u);
    Motion<V, D> motion;
    load_velocity(g, b, data.layout, motion);
    Transfer::gather(g, point, par.flip_blend, motion);
    move_particle(g, b, par, motion, u);
    store_motion(g, b, data.layout, motion);
    const Mat3<V> increment = gradient_increment(motion, step_over_cell<V>(g, b, par));
    for (int c = 0; c < D; ++c) g.store(b, c, u[c]);
    store_increment<V, D>(g, b, data.layout, increment);
  });
}

/// Material update from the stored dt grad v; also the stress of a state at rest (split path).
template <class Material, class G, int D, class T>
SCREE_FN void stress_block(G& g, const PassData<D, T>& data,
                           const typename Material::template Params<T>& material) {
  using V = typename G::V;
  g.each_batch([&](const typename G::Batch& b) {
    V u[D];
    V velocity[D];
    load_position(g, b, u);
    Mat3<V> increment = zero3<V>();
    for (int c = 0; c < D; ++c) {
      velocity[c] = g.load_aux(b, data.layout.velocity + c);
      if (data.layout.increment < 0) continue;
      for (int a = 0; a < D; ++a) {
        increment(c, a) = g.load_aux(b, data.layout.increment + c * D + a);
      }
    }
    const Sym3<V> tau =
        update_material<Material>(g, b, data.parameters, material, increment, u, velocity);
    store_stress(g, b, data.layout, tau);
  });
}

/// What a batch carries through the material update.
template <class V, int D>
struct Underway {
  V u[D];
  V velocity[D];
  V affine[D][D];
  Mat3<V> increment;  ///< dt grad v
  V live;
};

/// Gathers, moves the particles and stores their positions, and what pore water needs of the step.
template <class Kernel, class G, class V, int D, class T>
SCREE_FN void gather_and_move(G& g, const typename G::Batch& b, const PassData<D, T>& data,
                              Underway<V, D>& p) {
  const PassParameters<T>& par = data.parameters;
  V u[D];
  load_position(g, b, u);
  Motion<V, D> motion;
  Mls<Kernel>::gather(g, Kernel::template at<V, D>(u), par.flip_blend, motion);
  const bool stride = in_stride<G>(data);
  if (stride) {
    p.increment = gradient_increment(motion, step_over_cell<V>(g, b, par));
    p.live = follow_stride<Kernel>(g, b, data, motion, p.increment, u);
  } else {
    p.live = move_particle(g, b, par, motion, u);
  }
  for (int c = 0; c < D; ++c) {
    if (!stride) g.store(b, c, u[c]);
    p.u[c] = u[c];
    p.velocity[c] = motion.velocity[c];
    for (int a = 0; a < D; ++a) p.affine[c][a] = motion.affine[c][a];
  }
  // Last: a GPU has no registers for it before.
  if (!stride) p.increment = gradient_increment(motion, step_over_cell<V>(g, b, par));
}

/// Scatters with the stress tau [Pa].
template <class Kernel, class G, class V, int D, class T>
SCREE_FN void return_to_grid(G& g, const typename G::Batch& b, const PassData<D, T>& data,
                             const Underway<V, D>& p, const Sym3<V>& tau) {
  const PassParameters<T>& par = data.parameters;
  V u[D];
  Motion<V, D> motion;
  for (int c = 0; c < D; ++c) {
    u[c] = g.load_again(b, c, p.u[c]);
    motion.velocity[c] = p.velocity[c];
    for (int a = 0; a < D; ++a) motion.affine[c][a] = p.affine[c][a];
  }
  if (par.record) {
    store_motion(g, b, data.layout, motion);
    store_stress(g, b, data.layout, tau);
  }
  const auto point = Kernel::template at<V, D>(u);
  if constexpr (G::takes_pore_water) {
    Impulse<V, D> impulse = make_impulse<V, D>(par, tau);
    add_gained_weight(data, g, b, impulse);
    Mls<Kernel>::scatter(g, point, par.particle_mass, motion, impulse, false, p.live);
  } else {  // an impulse with a name would cost a GPU's kernel registers
    Mls<Kernel>::scatter(g, point, par.particle_mass, motion, make_impulse<V, D>(par, tau), false,
                         p.live);
  }
}

/// The material update of the batches of a set together.
template <class Material, class G, class V, int D, class T, int n>
SCREE_FN auto update_together(G& g, const BatchSet<typename G::Batch, n>& set,
                              const PassParameters<T>& par,
                              const typename Material::template Params<T>& material,
                              const Underway<V, D> (&p)[n]) {
  if constexpr (n == 1) {
    return update_material<Material>(g, set.batch[0], par, material, p[0].increment, p[0].u,
                                     p[0].velocity);
  } else {
    using W = typename PairedGroup<G>::V;
    PairedGroup<G> both(g);
    Mat3<W> increment;
    W u[D];
    W velocity[D];
    for (int c = 0; c < 3; ++c) {
      for (int a = 0; a < 3; ++a) {
        increment(c, a) = {p[0].increment(c, a), p[1].increment(c, a)};
      }
    }
    for (int c = 0; c < D; ++c) {
      u[c] = {p[0].u[c], p[1].u[c]};
      velocity[c] = {p[0].velocity[c], p[1].velocity[c]};
    }
    return update_material<Material>(both, set, par, material, increment, u, velocity);
  }
}

/// The fused pass: gather the new grid velocities, move and deform the particle, return its stress
/// to the next step's grid. Only position and material state are stored; velocity, affine matrix
/// and stress leave the registers on request (par.record). With pore water particles go on stride
/// by stride.
template <class Kernel, class Material, class G, int D, class T>
SCREE_FN void g2p2g_block(G& g, const PassData<D, T>& data,
                          const typename Material::template Params<T>& material) {
  using V = typename G::V;
  const PassParameters<T>& par = data.parameters;
  g.stage_in(0);
  if (in_stride<G>(data) && data.stride.sums(par.record)) g.stage_in(1);
  g.clear(0);
  g.sync();
  constexpr int size = std::min(G::max_set, batches_together<Material>);
  g.template each_set<size>([&](const BatchSet<typename G::Batch, size>& set) {
    Underway<V, D> p[size];
    SCREE_UNROLL_ON_DEVICE for (int i = 0; i < size; ++i) {
      if (set.holds(i)) gather_and_move<Kernel>(g, set.batch[i], data, p[i]);
    }
    if (set.parts < size) p[size - 1] = p[0];
    const auto tau = update_together<Material>(g, set, par, material, p);
    SCREE_UNROLL_ON_DEVICE for (int i = 0; i < size; ++i) {
      if (set.holds(i)) {
        return_to_grid<Kernel>(g, set.batch[i], data, p[i], part_of<size>(tau, i));
      }
    }
  });
  g.sync();
  g.stage_out(0);
}

}  // namespace scree
