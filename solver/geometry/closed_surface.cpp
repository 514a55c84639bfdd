// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/closed_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace scree {
namespace {

using Point = TriangleMesh::Point;
using Triangle = TriangleMesh::Triangle;

/// The edges that an odd number of triangles shares.
std::vector<MeshEdge> open_edges(const TriangleMesh& mesh) {
  const std::vector<MeshEdge> edges = sorted_edges(mesh);
  std::vector<MeshEdge> open;
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last].same_points(edges[first])) ++last;
    if ((last - first) % 2 != 0) open.push_back(edges[first]);
  }
  return open;
}

void check_finite(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (const double x : mesh.points[i])
      if (!std::isfinite(x))
        throw GeometryFault("file", fmt::format("its point number {} is not finite: {}", i + 1,
                                                place_of(mesh.points[i])));
}

/// The points that triangles use get new numbers, in the order of the old ones.
void drop_unused_points(TriangleMesh& mesh) {
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t p : t) number[std::size_t(p)] = 0;
  std::vector<Point> points;
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] < 0) continue;
    number[p] = std::int32_t(points.size());
    points.push_back(mesh.points[p]);
  }
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& p : t) p = number[std::size_t(p)];
  mesh.points = std::move(points);
}

}  // namespace

std::vector<MeshEdge> sorted_edges(const TriangleMesh& mesh) {
  std::vector<MeshEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t s = 0; s < 3; ++s) {
      const auto [low, high] = std::minmax(mesh.triangles[t][s], mesh.triangles[t][(s + 1) % 3]);
      edges.push_back({low, high, std::int32_t(t), int(s)});
    }
  std::sort(edges.begin(), edges.end(), [](const MeshEdge& a, const MeshEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

void merge_points(TriangleMesh& mesh) {
  check_finite(mesh);
  std::vector<std::int32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](std::int32_t i) -> const Point& { return mesh.points[std::size_t(i)]; };
  std::sort(order.begin(), order.end(),
            [&](std::int32_t i, std::int32_t j) { return at(i) != at(j) ? at(i) < at(j) : i < j; });
  std::vector<std::int32_t> twin(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && at(order[k]) == at(order[k - 1]);
    twin[std::size_t(order[k])] = same ? twin[std::size_t(order[k - 1])] : order[k];
  }
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& p : t) p = twin[std::size_t(p)];
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  if (mesh.triangles.empty()) throw GeometryFault("file", "holds no triangle with three corners");
  drop_unused_points(mesh);
}

void drop_twins(TriangleMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::pair<Triangle, std::size_t>> sorted(count);
  for (std::size_t t = 0; t < count; ++t) {
    sorted[t] = {mesh.triangles[t], t};
    std::sort(sorted[t].first.begin(), sorted[t].first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<char> gone(count, 0);
  for (std::size_t k = 1; k < count; ++k) {
    if (sorted[k].first != sorted[k - 1].first || gone[sorted[k - 1].second]) continue;
    gone[sorted[k].second] = gone[sorted[k - 1].second] = 1;
  }
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < count; ++t)
    if (!gone[t]) kept.push_back(mesh.triangles[t]);
  if (kept.empty())
    throw GeometryFault("file", "encloses nothing: each of its triangles occurs twice");
  if (kept.size() == count) return;
  mesh.triangles = std::move(kept);
  drop_unused_points(mesh);
}

void extrude(TriangleMesh& mesh, const std::array<double, 3>& step) {
  const std::vector<MeshEdge> rim = open_edges(mesh);
  if (rim.empty())
    throw GeometryFault("extrude", "is for open sheets, but the surface of the file is closed");
  const std::int32_t shift = std::int32_t(mesh.points.size());
  const std::size_t sheet = mesh.triangles.size();
  for (std::int32_t p = 0; p < shift; ++p) {
    Point moved = mesh.points[std::size_t(p)];
    for (std::size_t a = 0; a < 3; ++a) moved[a] += step[a];
    mesh.points.push_back(moved);
  }
  for (std::size_t t = 0; t < sheet; ++t) {
    const Triangle top = mesh.triangles[t];
    mesh.triangles.push_back({top[0] + shift, top[2] + shift, top[1] + shift});
  }
  for (const MeshEdge& e : rim) {
    mesh.triangles.push_back({e.low, e.high, e.high + shift});
    mesh.triangles.push_back({e.low, e.high + shift, e.low + shift});
  }
}

void check_closed(const TriangleMesh& mesh) {
  const std::vector<MeshEdge> open = open_edges(mesh);
  if (open.empty()) return;
  throw GeometryFault(
      "file",
      fmt::format("is not closed: {} {} a triangle on one side only, the first from {} to {} m; "
                  "close the holes, or give an open sheet a thickness with extrude",
                  open.size(), open.size() == 1 ? "edge has" : "edges have",
                  place_of(mesh.points[std::size_t(open[0].low)]),
                  place_of(mesh.points[std::size_t(open[0].high)])));
}

void check_crossings(const TriangleMesh& mesh, const TriangleTree& tree) {
  const auto [s, t] = tree.crossing_pair();
  if (s < 0) return;
  // The centre of what the boxes of the two have in common.
  Point place;
  for (std::size_t a = 0; a < 3; ++a) {
    double lower = -INFINITY, upper = INFINITY;
    for (const std::int32_t triangle : {s, t}) {
      const Triangle& corners = mesh.triangles[std::size_t(triangle)];
      const auto x = [&](std::size_t i) { return mesh.points[std::size_t(corners[i])][a]; };
      lower = std::max(lower, std::min({x(0), x(1), x(2)}));
      upper = std::min(upper, std::max({x(0), x(1), x(2)}));
    }
    place[a] = 0.5 * (lower + upper);
  }
  throw GeometryFault(
      "file",
      fmt::format("{} itself near {} m; separate the surfaces, or give "
                  "each a file of its own and unite them with a union",
                  tree.lie_on_each_other(s, t) ? "lies on" : "passes through", place_of(place)));
}

std::int64_t turn_outward(TriangleMesh& mesh, const TriangleTree& tree) {
  std::int64_t turned = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle& corners = mesh.triangles[t];
    const Point &a = mesh.points[std::size_t(corners[0])],
                &b = mesh.points[std::size_t(corners[1])],
                &c = mesh.points[std::size_t(corners[2])];
    double center[3], normal[3];
    int axis = 0;  // the one nearest to the normal
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
      center[i] = a[i] + (b[i] - a[i]) / 3 + (c[i] - a[i]) / 3;
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = int(i);
    }
    if (normal[axis] == 0) continue;
    const bool solid_above = tree.odd_crossings(center, axis, std::int32_t(t));
    if (solid_above == (normal[axis] < 0)) continue;
    std::swap(corners[1], corners[2]);
    ++turned;
  }
  return turned;
}

}  // namespace scree
