// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/geometry/predicates.hpp"

namespace scree {
namespace {

constexpr std::int32_t most_in_leaf = 4;
/// Halving 2^31 triangles takes 31 levels; each adds one node to a stack.
constexpr int deepest = 64;

double square_distance(const double x[3], const std::array<double, 3>& lower,
                       const std::array<double, 3>& upper) {
  double sum = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double gap = std::max({lower[a] - x[a], 0.0, x[a] - upper[a]});
    sum += gap * gap;
  }
  return sum;
}

using Corners = std::array<const double*, 3>;

/// Turns the corners of a triangle on until the first is alone on its side of the plane of the
/// other. Returns that side, 1 above and -1 below the triangle, or 0 where no corner is.
int turn_to_lone_corner(Corners& corners, const Corners& other) {
  int count[3] = {0, 0, 0}, sides[3];
  for (std::size_t i = 0; i < 3; ++i) {
    sides[i] = -certain_orientation(other[0], other[1], other[2], corners[i]);
    ++count[sides[i] + 1];
  }
  if (count[0] == 0 || count[2] == 0) return 0;
  const int lone = count[2] == 1 ? 1 : -1;
  const auto first = std::find(sides, sides + 3, lone) - sides;
  std::rotate(corners.begin(), corners.begin() + first, corners.end());
  return lone;
}

bool in_plane_of(const Corners& t, const Corners& plane) {
  return std::all_of(t.begin(), t.end(), [&](const double* x) {
    return certain_orientation(plane[0], plane[1], plane[2], x) == 0;
  });
}

using FlatTriangle = std::array<std::array<double, 2>, 3>;

/// Without the axis; counterclockwise. Nothing for a triangle without area there.
std::optional<FlatTriangle> flattened(const Corners& t, std::size_t axis) {
  FlatTriangle flat;
  for (std::size_t i = 0; i < 3; ++i) flat[i] = {t[i][(axis + 1) % 3], t[i][(axis + 2) % 3]};
  const int turn = orientation(flat[0].data(), flat[1].data(), flat[2].data());
  if (turn == 0) return std::nullopt;
  if (turn < 0) std::swap(flat[1], flat[2]);
  return flat;
}

/// True if the line through a side of s has t on its other side: then they have no area in common.
bool side_parts(const FlatTriangle& s, const FlatTriangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto beyond = [&](const std::array<double, 2>& x) {
      return orientation(s[i].data(), s[(i + 1) % 3].data(), x.data()) <= 0;
    };
    if (std::all_of(t.begin(), t.end(), beyond)) return true;
  }
  return false;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh) {
  const std::size_t count = mesh.triangles.size();
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0);
  // Centres only decide who sits with whom: single precision does.
  std::vector<float> centers(3 * count);
  for (std::size_t t = 0; t < count; ++t)
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i)
        centers[3 * t + std::size_t(a)] += float(corner(std::int32_t(t), i)[a] / 3);
  nodes_.reserve(count + 1);
  build(0, std::int32_t(count), centers);
}

void TriangleTree::enclose(Node& node, std::int32_t first, std::int32_t last) const {
  node.lower.fill(std::numeric_limits<double>::infinity());
  node.upper.fill(-std::numeric_limits<double>::infinity());
  for (std::int32_t k = first; k < last; ++k)
    for (int i = 0; i < 3; ++i) {
      const double* x = corner(order_[std::size_t(k)], i);
      for (std::size_t a = 0; a < 3; ++a) {
        node.lower[a] = std::min(node.lower[a], x[a]);
        node.upper[a] = std::max(node.upper[a], x[a]);
      }
    }
}

/// Halves the triangles at the median of their centres along the longest side of the box.
std::int32_t TriangleTree::build(std::int32_t first, std::int32_t last,
                                 const std::vector<float>& centers) {
  const std::int32_t self = std::int32_t(nodes_.size());
  Node node;
  enclose(node, first, last);
  if (last - first <= most_in_leaf) {
    node.first = first;
    node.count = last - first;
    nodes_.push_back(node);
    return self;
  }
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (node.upper[a] - node.lower[a] > node.upper[axis] - node.lower[axis]) axis = a;
  const std::int32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::int32_t s, std::int32_t t) {
                     const float cs = centers[3 * std::size_t(s) + axis];
                     const float ct = centers[3 * std::size_t(t) + axis];
                     return cs != ct ? cs < ct : s < t;
                   });
  nodes_.push_back(node);
  build(first, middle, centers);
  const std::int32_t second = build(middle, last, centers);
  nodes_[std::size_t(self)].first = second;
  return self;
}

NearestPoint TriangleTree::nearest(const double x[3]) const {
  NearestPoint best;
  std::pair<double, std::int32_t> stack[deepest];
  int size = 0;
  stack[size++] = {square_distance(x, nodes_[0].lower, nodes_[0].upper), 0};
  while (size > 0) {
    const auto [square, index] = stack[--size];
    if (square > best.square) continue;
    const Node& node = nodes_[std::size_t(index)];
    for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
      const std::int32_t t = order_[std::size_t(k)];
      NearestPoint near = nearest_on_triangle(corner(t, 0), corner(t, 1), corner(t, 2), x);
      if (near.square > best.square || (near.square == best.square && t > best.triangle)) continue;
      near.triangle = t;
      best = near;
    }
    if (node.count > 0) continue;
    std::pair<double, std::int32_t> child[2] = {{0, index + 1}, {0, node.first}};
    for (auto& c : child) {
      const Node& inner = nodes_[std::size_t(c.second)];
      c.first = square_distance(x, inner.lower, inner.upper);
    }
    if (child[0].first < child[1].first) std::swap(child[0], child[1]);
    stack[size++] = child[0];
    stack[size++] = child[1];  // the nearer one is next
  }
  return best;
}

bool TriangleTree::crosses_ray(std::int32_t triangle, const double x[3], int axis) const {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  double p[4][2];
  for (int i = 0; i < 3; ++i) {
    p[i][0] = corner(triangle, i)[b];
    p[i][1] = corner(triangle, i)[c];
  }
  p[3][0] = x[b];
  p[3][1] = x[c];
  const int sign = perturbed_orientation(p[0], p[1], p[3]);
  if (sign == 0 || perturbed_orientation(p[1], p[2], p[3]) != sign ||
      perturbed_orientation(p[2], p[0], p[3]) != sign)
    return false;
  return sign *
             certain_orientation(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2), x) >
         0;
}

bool TriangleTree::odd_crossings(const double x[3], int axis, std::int32_t without) const {
  const std::size_t a = std::size_t(axis), b = (a + 1) % 3, c = (a + 2) % 3;
  bool odd = false;
  std::int32_t stack[deepest];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::int32_t index = stack[--size];
    const Node& node = nodes_[std::size_t(index)];
    if (x[a] > node.upper[a] || x[b] < node.lower[b] || x[b] > node.upper[b] ||
        x[c] < node.lower[c] || x[c] > node.upper[c])
      continue;
    for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
      const std::int32_t t = order_[std::size_t(k)];
      if (t != without && crosses_ray(t, x, axis)) odd = !odd;
    }
    if (node.count > 0) continue;
    stack[size++] = index + 1;
    stack[size++] = node.first;
  }
  return odd;
}

/// True if s and t have a line in common that runs through the inside of both. The planes' line
/// cuts a chord out of each, between the corner that is alone on its side of the other's plane and
/// the two others; the chords overlap if each begins before the other ends (Devillers and Guigue,
/// INRIA RR-4488, 2002). Triangles that share corners or sides, lie in each other's planes or touch
/// there have no such line.
bool TriangleTree::pass_through(std::int32_t s, std::int32_t t) const {
  Corners first = corners(s), second = corners(t);
  const int side_of_first = turn_to_lone_corner(first, second);
  const int side_of_second = side_of_first == 0 ? 0 : turn_to_lone_corner(second, first);
  if (side_of_second == 0) return false;
  // Each lone corner above the other triangle.
  if (side_of_first < 0) std::swap(second[1], second[2]);
  if (side_of_second < 0) std::swap(first[1], first[2]);
  return certain_orientation(first[0], first[1], second[0], second[1]) > 0 &&
         certain_orientation(first[0], first[2], second[2], second[0]) > 0;
}

bool TriangleTree::lie_on_each_other(std::int32_t s, std::int32_t t) const {
  const Corners first = corners(s), second = corners(t);
  if (!in_plane_of(first, second) || !in_plane_of(second, first)) return false;
  // Seen along any axis in which both have an area, they overlap or not.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto one = flattened(first, axis), other = flattened(second, axis);
    if (one && other) return !side_parts(*one, *other) && !side_parts(*other, *one);
  }
  return false;
}

/// A later triangle that passes through this one or lies on it, or -1.
std::int32_t TriangleTree::crossed_by(std::int32_t triangle) const {
  std::array<double, 3> lower, upper;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto range =
        std::minmax({corner(triangle, 0)[a], corner(triangle, 1)[a], corner(triangle, 2)[a]});
    lower[a] = range.first;
    upper[a] = range.second;
  }
  std::int32_t stack[deepest];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::int32_t index = stack[--size];
    const Node& node = nodes_[std::size_t(index)];
    bool apart = false;
    for (std::size_t a = 0; a < 3; ++a)
      apart = apart || node.lower[a] > upper[a] || node.upper[a] < lower[a];
    if (apart) continue;
    for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
      const std::int32_t t = order_[std::size_t(k)];
      if (t > triangle && (pass_through(triangle, t) || lie_on_each_other(triangle, t))) return t;
    }
    if (node.count > 0) continue;
    stack[size++] = index + 1;
    stack[size++] = node.first;
  }
  return -1;
}

std::pair<std::int32_t, std::int32_t> TriangleTree::crossing_pair() const {
  for (std::int32_t t = 0; t < std::int32_t(order_.size()); ++t)
    if (const std::int32_t other = crossed_by(t); other >= 0) return {t, other};
  return {-1, -1};
}

}  // namespace scree
