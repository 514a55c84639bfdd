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

enum class FaceRule { sticky, mirror, odd };

/// A plane face normal to `axis`: the material is above the coordinate (lower face) or below it
/// (upper face). The coordinate [m] is a multiple of half a cell. A ghost node behind the plane
/// moves with R times the velocity of its mirror node. mirror: R = diag(-1 normal, 1 tangential),
/// exact symmetry. sticky: R = diag(-1 normal, 0 tangential), and the ghost's tangential momentum
/// is lost. odd: R = -1, a held wall with no slip on the plane itself.
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

  /// Adds mass, R momentum and R force (weight included) of the ghosts behind faces to their mirror
  /// nodes and removes the ghosts, mirrors before held walls; then v = momentum/mass + dt
  /// force/mass, and the part of v that R turns around is zero on the planes.
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
  static Vector reflection(const Face& face);

  double cell_size_;
  Nodes nodes_;
};

}  // namespace scree::reference
