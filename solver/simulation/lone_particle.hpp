// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/simulation/simulation.hpp"

namespace scree {

/// Largest c dt/dx, c the speed of sound, at which a fluid particle stays in one piece that has its
/// nodes to itself, as a drop of spray does; infinite where the kernel has no bound.
///
/// Pressure and dilation of such a particle are an oscillator of its own, stiffer than any wave
/// that the grid carries between particles. With the volume strain e, the rate b [1/step] that the
/// affine matrix remembers, and k = (c dt/dx)^2,
///
///     b' = b - k a e,    e' = e + b - k g e,    stable for k (g - a/2) < 2
///
/// where a = tr D^-1 dx^2 (0 for transfers without an affine matrix) and g = a for mls, else the
/// mean over the lattices of sum |grad w|^2/w dx^2. Their largest values over all positions:
/// docs/method.md, section 3.
double lone_particle_courant(KernelType kernel, TransferType transfer, int dimension);

/// The share of dx/(c + |v|) that a step may have: time.cfl, for fluids bounded by their drops. As
/// pressures are not linear, large swings need a distance from the bound: in 3D k a < 2, a swing of
/// more than four steps, below the resonance that the change of the step drives; in the plane,
/// where spray is rare, a tenth of the bound, with which mls keeps the default.
double courant_number(const SimulationSetup& setup);

}  // namespace scree
