// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/boundary/face_type.hpp"

namespace scree {

template <class S>
class Schema;

/// The deck names of the face types.
inline const std::vector<std::pair<std::string, FaceType>>& face_type_names() {
  static const std::vector<std::pair<std::string, FaceType>> names{
      {"sticky", FaceType::sticky},     {"slip", FaceType::slip}, {"separate", FaceType::separate},
      {"friction", FaceType::friction}, {"open", FaceType::open}, {"periodic", FaceType::periodic},
      {"symmetry", FaceType::symmetry}};
  return names;
}

inline const std::vector<std::pair<std::string, NoSlip>>& no_slip_names() {
  static const std::vector<std::pair<std::string, NoSlip>> names{{"node", NoSlip::node},
                                                                 {"face", NoSlip::face}};
  return names;
}

/// One entry of `[boundary]`: a name, or a table {type, coefficient}.
struct FaceSpec {
  FaceType type = FaceType::open;
  double coefficient = 0;  ///< Coulomb's mu >= 0; required with friction, not allowed otherwise
};

/// `[boundary]`: the six faces of the domain; in 2D the z faces are not used. A periodic face needs
/// its opposite face periodic too.
struct BoundarySpec {
  FaceSpec x_min, x_max, y_min, y_max, z_min, z_max;
  NoSlip no_slip = NoSlip::node;  ///< face needs a sticky or friction face

  /// The face below (side 0) or above (side 1) the domain in `axis`.
  const FaceSpec& face(int axis, int side) const {
    const FaceSpec* const faces[3][2] = {{&x_min, &x_max}, {&y_min, &y_max}, {&z_min, &z_max}};
    return *faces[axis][side];
  }
};

const Schema<FaceSpec>& face_schema();
const Schema<BoundarySpec>& boundary_schema();

}  // namespace scree
