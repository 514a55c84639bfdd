// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// Interpolation kernel. compact: dual grid, 2 nodes an axis and lattice (Liu, Wang, Li 2025);
/// quadratic: B-spline, 3 nodes an axis; linear: hat functions, 2 nodes an axis (baseline).
enum class KernelType { compact, quadratic, linear };

/// Particle-grid transfer. mls and apic carry an affine matrix; flip blends increments; pic damps.
enum class TransferType { mls, apic, flip, pic };

/// Floating-point type of particles and grid.
enum class Precision { double_, single_ };

/// Damping of the grid equation of motion: none, local (Cundall, fraction of the out-of-balance
/// force) or mass (proportional to momentum, 1/s).
enum class DampingType { none, local, mass };

/// How a step is computed. fused: one pass gathers, updates and scatters (mls only);
/// split: separate passes (every transfer); automatic: fused where the method allows it.
enum class PathType { automatic, fused, split };

}  // namespace scree
