// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/step/body.hpp"

namespace scree {

/// Where the volumes of a body's particles are found.
struct VolumeFields {
  int ratio = 0;    ///< aux: total J
  int plastic = 0;  ///< aux: ln(J/J_e) after the step before the last
  /// First of the nine entries of the elastic deformation gradient among the particles' fields; -1:
  /// the law does not flow or keeps no gradient, all of its change of volume counts as elastic.
  int gradient = -1;
};

/// Number of aux fields, one after the other.
inline constexpr int volume_aux_fields = 2;

/// Of a body whose aux fields of volumes begin at `first`.
template <int D, class T>
VolumeFields volume_fields(const Body<D, T>& body, int first) {
  int gradient = -1;
  bool flows = false;
  for (const StateColumn& column : body.columns()) {
    if (column.name == "deformation_gradient") gradient = D + column.first;
    flows |= column.name.find("plastic") != std::string::npos;
  }
  return {first, first + 1, flows ? gradient : -1};
}

}  // namespace scree
