// SPDX-License-Identifier: Apache-2.0
//
// The motion of manufactured_solution in the unit cube, phi = (0, pi, 0); its derivation stands
// there.
#pragma once

#include "verification/cases/manufactured_solution/exact.hpp"

namespace scree::verify::cases::manufactured_solution_3d {

struct Case : manufactured_solution::MotionCase<3> {};

}  // namespace scree::verify::cases::manufactured_solution_3d
