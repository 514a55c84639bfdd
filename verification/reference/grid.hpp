// SPDX-License-Identifier: Apache-2.0
//
// The reference grid: an ordered map of nodes, and the rules of plane faces.
#pragma once

#include <map>
#include <vector>

#include "verification/reference/kernel.hpp"

namespace scree::reference {

struct GridNode {
  double mass = 0;                          ///< kg
  Vector momentum = Vector::Zero();         ///< kg m/s, before forces
  Vector force = Vector::Zero();            ///< N
  Vector velocity = Vector::Zero();         ///< m/s, after forces and faces
  Vector velocity_before = Vector::Zero();  ///< m/s, before forces and faces
};

enum class FaceRule { sticky, mirror };

/// A plane face normal to `axis`: the material is above the coordinate (lower face) or below it
/// (upper face). mirror: exact symmetry, the coordinate [m] must be a multiple of half a cell.
/// sticky: v = 0 on and behind the plane.
struct Face {
  int axis;
  bool upper;
  double coordinate;
  FaceRule rule;
};

class Grid {
 public:
  using Nodes = std::map<Node, GridNode>;

  explicit Grid(double cell_size) : cell_size_(cell_size) {}

  Nodes& nodes() { return nodes_; }
  const Nodes& nodes() const { return nodes_; }

  /// Adds the ghosts behind mirror faces to their mirror nodes, the normal momentum and force with
  /// changed sign, and removes them; then v = momentum/mass + dt (force/mass + gravity), and v_n =
  /// 0 on the planes, v = 0 behind sticky faces.
  void update(double dt, const Vector& gravity, const std::vector<Face>& faces);

  /// Velocities seen by a particle: those of a ghost are the mirrored ones. Zero where nothing was
  /// scattered.
  GridNode at(Node node, const std::vector<Face>& faces) const;

 private:
  double coordinate(const Node& node, int axis) const;
  bool behind(const Node& node, const Face& face) const;
  bool on_plane(const Node& node, const Face& face) const;
  Node mirrored(const Node& node, const Face& face) const;
  void fold(const Face& face);

  double cell_size_;
  Nodes nodes_;
};

}  // namespace scree::reference
