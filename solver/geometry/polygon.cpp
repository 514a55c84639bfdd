// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/polygon.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "solver/geometry/predicates.hpp"

namespace scree {
namespace {

using Flat = std::array<double, 2>;

/// The corners without the coordinate that is most nearly normal to the polygon, counter-clockwise.
std::vector<Flat> flatten(const TriangleMesh& mesh, const std::vector<std::int32_t>& corners) {
  double area[3] = {0, 0, 0};
  const TriangleMesh::Point& o = mesh.points[std::size_t(corners[0])];
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const TriangleMesh::Point& p = mesh.points[std::size_t(corners[k])];
    const TriangleMesh::Point& q = mesh.points[std::size_t(corners[(k + 1) % corners.size()])];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      area[a] += (p[b] - o[b]) * (q[c] - o[c]) - (p[c] - o[c]) * (q[b] - o[b]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (std::abs(area[a]) > std::abs(area[axis])) axis = a;
  std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
  if (area[axis] < 0) std::swap(b, c);
  std::vector<Flat> flat;
  for (const std::int32_t corner : corners) {
    const TriangleMesh::Point& p = mesh.points[std::size_t(corner)];
    flat.push_back({p[b], p[c]});
  }
  return flat;
}

bool holds(const Flat& a, const Flat& b, const Flat& c, const Flat& p) {
  return orientation(a.data(), b.data(), p.data()) >= 0 &&
         orientation(b.data(), c.data(), p.data()) >= 0 &&
         orientation(c.data(), a.data(), p.data()) >= 0;
}

/// True if the corner `k` of the outline `left` can be cut off.
bool is_ear(const std::vector<Flat>& flat, const std::vector<std::size_t>& left, std::size_t k) {
  const std::size_t count = left.size();
  const Flat &a = flat[left[(k + count - 1) % count]], &b = flat[left[k]],
             &c = flat[left[(k + 1) % count]];
  if (orientation(a.data(), b.data(), c.data()) <= 0) return false;
  for (const std::size_t other : left) {
    const Flat& p = flat[other];
    if (p == a || p == b || p == c) continue;
    if (holds(a, b, c, p)) return false;
  }
  return true;
}

}  // namespace

void add_polygon(TriangleMesh& mesh, const std::vector<std::int32_t>& corners) {
  if (corners.size() == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const std::vector<Flat> flat = flatten(mesh, corners);
  std::vector<std::size_t> left(corners.size());
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
  while (left.size() >= 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(flat, left, ear)) ++ear;
    // No ear: corners on a line, or an outline that crosses itself; any triangle keeps it closed.
    if (ear == left.size()) ear = 0;
    const std::size_t count = left.size();
    mesh.triangles.push_back({corners[left[(ear + count - 1) % count]], corners[left[ear]],
                              corners[left[(ear + 1) % count]]});
    left.erase(left.begin() + std::ptrdiff_t(ear));
  }
}

}  // namespace scree
