// SPDX-License-Identifier: Apache-2.0
#include "postproc/runout/scaling_laws.hpp"

#include <cmath>

namespace scree {

ScalingLaw lube(double a, bool axisymmetric) {
  ScalingLaw law;
  if (axisymmetric) {
    law.name = "Lube et al. (2004)";
    law.runout = a < 1.7 ? 1.24 * a : 1.6 * std::sqrt(a);
    law.height = a < 1 ? a : 0.88 * std::pow(a, 1.0 / 6);
  } else {
    law.name = "Lube et al. (2005)";
    // The paper gives 1.2 a below 1.8 and the power above 2.8; up to there the line is continued.
    law.runout = a <= 2.8 ? 1.2 * a : 1.9 * std::pow(a, 2.0 / 3);
    law.height = a < 1.15 ? a : 0.65 * std::pow(a, 0.4);
  }
  return law;
}

ScalingLaw lajeunesse(double a, bool axisymmetric) {
  ScalingLaw law;
  law.name = "Lajeunesse et al. (2005)";
  if (axisymmetric) {
    law.runout = a < 3 ? a : std::sqrt(3 * a);
    law.height = a < 0.74 ? a : 0.74;
  } else {
    law.runout = a < 3 ? 1.2 * a : 1.9 * std::pow(a, 2.0 / 3);
    law.height = a < 0.7 ? a : std::cbrt(a);
  }
  return law;
}

double collapse_time(double height, double gravity) { return 3.3 * std::sqrt(height / gravity); }

}  // namespace scree
