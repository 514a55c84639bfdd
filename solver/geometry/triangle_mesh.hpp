// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree {

/// Triangles over shared points. Nothing is promised about closedness or orientation.
struct TriangleMesh {
  using Point = std::array<double, 3>;
  using Triangle = std::array<std::int32_t, 3>;

  std::vector<Point> points;  ///< m, or the file's unit before it is scaled
  std::vector<Triangle> triangles;
};

/// What is wrong with a file of geometry: a mistake of the user.
class GeometryFault : public std::runtime_error {
 public:
  /// \param key of the shape to which the message belongs: "file", "region", ...
  GeometryFault(std::string key, const std::string& message)
      : std::runtime_error(message), key_(std::move(key)) {}
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// A place as messages name it: "(1, 2.5, -3)".
std::string place_of(const TriangleMesh::Point& x);

/// The file's numbers scaled, then turned about an axis through the origin, then shifted.
struct Placement {
  double scale = 1;                     ///< m per unit of the file; > 0
  std::array<double, 3> axis{0, 0, 1};  ///< any length > 0
  double angle = 0;                     ///< rad, right-handed about the axis
  std::array<double, 3> shift{};        ///< m

  TriangleMesh::Point operator()(const TriangleMesh::Point& x) const;
};

}  // namespace scree
