// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

/// Signs of small determinants that rounding cannot turn.
namespace scree {

/// The sign (-1, 0, 1) of the area of the triangle a, b, c in the plane, exact for all finite
/// coordinates between 1e-140 and 1e140: rounding is bounded first, and where it could decide, the
/// determinant is summed without error (Shewchuk, Discrete Comput. Geom. 18, 1997, 305-363).
int orientation(const double a[2], const double b[2], const double c[2]);

/// The same with c moved by an infinitesimal step, so that it lies on no line through two points
/// (simulation of simplicity, Edelsbrunner & Muecke, ACM Trans. Graph. 9, 1990, 66-104): zero only
/// if a equals b. Antisymmetric in a and b.
int perturbed_orientation(const double a[2], const double b[2], const double c[2]);

/// The sign of the volume of a, b, c, d: positive if d lies on the side from which a, b, c turn
/// clockwise. Zero where rounding could decide.
int certain_orientation(const double a[3], const double b[3], const double c[3], const double d[3]);

}  // namespace scree
