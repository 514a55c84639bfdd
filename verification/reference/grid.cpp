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

Vector Grid::reflection(const Face& face) {
  const double along = face.rule == FaceRule::sticky ? 0 : face.rule == FaceRule::odd ? -1 : 1;
  Vector diagonal = Vector::Constant(along);
  diagonal[face.axis] = -1;
  return diagonal;
}

void Grid::fold(const Face& face) {
  const Vector R = reflection(face);
  Nodes inside;
  for (const auto& [node, value] : nodes_)
    if (!behind(node, face)) inside[node] = value;
  for (const auto& [node, value] : nodes_) {
    if (!behind(node, face)) continue;
    GridNode& target = inside[mirrored(node, face)];
    const double own = target.mass;
    target.mass += value.mass;
    // Along a held wall the node inside keeps its velocity: momentum and force grow with the mass.
    Vector growth = Vector::Ones();
    if (face.rule == FaceRule::sticky && own > 0) growth.setConstant(target.mass / own);
    growth[face.axis] = 1;
    target.momentum = growth.cwiseProduct(target.momentum) + R.cwiseProduct(value.momentum);
    target.force = growth.cwiseProduct(target.force) + R.cwiseProduct(value.force);
  }
  // A node on the plane is its own mirror: its image adds the same mass, which changes no velocity,
  // and turns the normal part of momentum and force around. update() zeroes what the wall takes.
  nodes_ = std::move(inside);
}

void Grid::update(double dt, const Vector& gravity, const std::vector<Face>& faces) {
  for (auto& [node, value] : nodes_) value.force += value.mass * gravity;
  for (const FaceRule rule : {FaceRule::mirror, FaceRule::sticky, FaceRule::odd})
    for (const Face& face : faces)
      if (face.rule == rule) fold(face);
  for (auto& [node, value] : nodes_) {
    if (value.mass == 0) continue;
    value.velocity_before = value.momentum / value.mass;
    value.velocity = value.velocity_before + dt * value.force / value.mass;
    for (const Face& face : faces) {
      if (!on_plane(node, face)) continue;
      Vector keep = reflection(face).cwiseMax(0);  // 1 along a mirror, 0 along a held wall
      keep[face.axis] = 0;
      value.velocity = value.velocity.cwiseProduct(keep);
      value.velocity_before = value.velocity_before.cwiseProduct(keep);
    }
  }
}

GridNode Grid::at(Node node, const std::vector<Face>& faces) const {
  Vector sign = Vector::Ones();
  for (const Face& face : faces)
    if (behind(node, face)) {
      node = mirrored(node, face);
      sign = sign.cwiseProduct(reflection(face));
    }
  const auto found = nodes_.find(node);
  if (found == nodes_.end()) return {};
  GridNode value = found->second;
  value.velocity = value.velocity.cwiseProduct(sign);
  value.velocity_before = value.velocity_before.cwiseProduct(sign);
  return value;
}

}  // namespace scree::reference
