// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scree {

/// What a face of the domain does to the material that meets it.
enum class FaceType { sticky, slip, separate, friction, open, periodic, symmetry };

/// The deck names of the face types.
inline const std::vector<std::pair<std::string, FaceType>>& face_type_names() {
  static const std::vector<std::pair<std::string, FaceType>> names{
      {"sticky", FaceType::sticky},     {"slip", FaceType::slip}, {"separate", FaceType::separate},
      {"friction", FaceType::friction}, {"open", FaceType::open}, {"periodic", FaceType::periodic},
      {"symmetry", FaceType::symmetry}};
  return names;
}

/// One entry of `[boundary]`: a name, or a table {type, coefficient}.
struct FaceSpec {
  FaceType type = FaceType::open;
  double coefficient = 0;  ///< Coulomb's mu >= 0; required with friction, not allowed otherwise
};

/// `[boundary]`: indices 0..5 are x_min, x_max, y_min, y_max, z_min, z_max; a periodic face needs
/// its opposite face periodic too.
inline const std::vector<std::string>& face_names() {
  static const std::vector<std::string> names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  return names;
}

}  // namespace scree
