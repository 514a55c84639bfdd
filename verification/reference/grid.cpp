// SPDX-License-Identifier: Apache-2.0
#include "verification/reference/grid.hpp"

#include <cmath>

namespace scree::reference {

double Grid::coordinate(const Node& node, int axis) const {
  return node_coordinate(node.lattice, node.index[axis], cell_size_);
}

// Nodes sit at multiples of dx/2, so a quarter of a cell separates "on" from "behind" safely.
bool Grid::behind(const Node& node, const Face& face) const {
  const double x = coordinate(node, face.axis) - face.coordinate;
  return (face.upper ? x : -x) > 0.25 * cell_size_;
}

bool Grid::on_plane(const Node& node, const Face& face) const {
  return std::abs(coordinate(node, face.axis) - face.coordinate) < 0.25 * cell_size_;
}

Node Grid::mirrored(const Node& node, const Face& face) const {
  // (i + s) dx -> 2 F - (i + s) dx, so i -> 2 F/dx - 2 s - i with 2 s = 0 on G- and 1 on G+.
  const int twice = static_cast<int>(std::lround(2 * face.coordinate / cell_size_));
  Node image = node;
  image.index[face.axis] = twice - node.lattice - node.index[face.axis];
  return image;
}

void Grid::fold(const Face& face) {
  Nodes inside;
  for (const auto& [node, value] : nodes_) {
    const bool ghost = behind(node, face);
    GridNode& target = inside[ghost ? mirrored(node, face) : node];
    Vector momentum = value.momentum, force = value.force;
    if (ghost) {
      momentum[face.axis] = -momentum[face.axis];
      force[face.axis] = -force[face.axis];
    }
    target.mass += value.mass;
    target.momentum += momentum;
    target.force += force;
  }
  // A node on the plane receives its mirror image's equal mass and opposite normal momentum as
  // well: v_n = 0 there, which update() sets; mass and tangential momentum both double, so the
  // tangential velocity needs no change.
  nodes_ = std::move(inside);
}

void Grid::update(double dt, const Vector& gravity, const std::vector<Face>& faces) {
  for (const Face& face : faces)
    if (face.rule == FaceRule::mirror) fold(face);
  for (auto& [node, value] : nodes_) {
    if (value.mass == 0) continue;
    value.velocity_before = value.momentum / value.mass;
    value.velocity = value.velocity_before + dt * (value.force / value.mass + gravity);
    for (const Face& face : faces) {
      if (face.rule == FaceRule::sticky) {
        if (on_plane(node, face) || behind(node, face)) value.velocity.setZero();
      } else if (on_plane(node, face)) {
        value.velocity[face.axis] = 0;
        value.velocity_before[face.axis] = 0;
      }
    }
  }
}

GridNode Grid::at(Node node, const std::vector<Face>& faces) const {
  Vector sign = Vector::Ones();
  for (const Face& face : faces)
    if (face.rule == FaceRule::mirror && behind(node, face)) {
      node = mirrored(node, face);
      sign[face.axis] = -sign[face.axis];
    }
  const auto found = nodes_.find(node);
  if (found == nodes_.end()) return {};
  GridNode value = found->second;
  value.velocity = value.velocity.cwiseProduct(sign);
  value.velocity_before = value.velocity_before.cwiseProduct(sign);
  return value;
}

}  // namespace scree::reference
