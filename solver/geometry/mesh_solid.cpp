// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/mesh_solid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/geometry/closed_surface.hpp"

namespace scree {
namespace {

using Point = TriangleMesh::Point;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void add(Point& sum, double factor, const Point& v) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] += factor * v[i];
}

/// Zero stays zero.
Point unit(const Point& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? Point{v[0] / length, v[1] / length, v[2] / length} : Point{};
}

}  // namespace

TriangleMesh MeshSolid::prepared(TriangleMesh mesh, const std::array<double, 3>& extrusion) {
  merge_points(mesh);
  drop_twins(mesh);
  if (extrusion != std::array<double, 3>{}) extrude(mesh, extrusion);
  check_closed(mesh);
  return mesh;
}

MeshSolid::MeshSolid(TriangleMesh mesh, const std::array<double, 3>& extrusion)
    : mesh_(prepared(std::move(mesh), extrusion)), tree_(mesh_) {
  check_crossings(mesh_, tree_);
  turned_ = turn_outward(mesh_, tree_);
  const Point diagonal = minus(upper(), lower());
  size_ = std::sqrt(dot(diagonal, diagonal));
  for (const auto& t : mesh_.triangles) {
    const auto at = [&](std::size_t i) { return minus(mesh_.points[std::size_t(t[i])], lower()); };
    volume_ += dot(at(0), cross(at(1), at(2))) / 6;
  }
  // Rounding of a sum of faces of that size.
  if (!(volume_ > 1e-15 * size_ * size_ * size_)) throw GeometryFault("file", "encloses no volume");
  find_normals();
}

void MeshSolid::find_normals() {
  face_normal_.resize(mesh_.triangles.size());
  edge_normal_.assign(3 * mesh_.triangles.size(), Point{});
  point_normal_.assign(mesh_.points.size(), Point{});
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& corners = mesh_.triangles[t];
    const auto at = [&](std::size_t i) { return mesh_.points[std::size_t(corners[i % 3])]; };
    face_normal_[t] = unit(cross(minus(at(1), at(0)), minus(at(2), at(0))));
    for (std::size_t i = 0; i < 3; ++i) {
      const Point u = minus(at(i + 1), at(i)), v = minus(at(i + 2), at(i)), w = cross(u, v);
      const double angle = std::atan2(std::sqrt(dot(w, w)), dot(u, v));
      add(point_normal_[std::size_t(corners[i])], angle, face_normal_[t]);
    }
  }
  for (Point& n : point_normal_) n = unit(n);
  const std::vector<MeshEdge> edges = sorted_edges(mesh_);
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    Point sum{};
    for (last = first; last < edges.size() && edges[last].same_points(edges[first]); ++last)
      add(sum, 1, face_normal_[std::size_t(edges[last].triangle)]);
    for (std::size_t e = first; e < last; ++e)
      edge_normal_[3 * std::size_t(edges[e].triangle) + std::size_t(edges[e].side)] = unit(sum);
  }
}

double MeshSolid::signed_distance(const double x[3]) const {
  const double distance = std::sqrt(tree_.nearest(x).square);
  return inside(x) ? -distance : distance;
}

const Point& MeshSolid::pseudonormal(const NearestPoint& near) const {
  const std::size_t t = std::size_t(near.triangle), i = std::size_t(near.feature.index);
  const Point* normal = &face_normal_[t];
  if (near.feature.kind == TriangleFeature::Kind::edge) normal = &edge_normal_[3 * t + i];
  if (near.feature.kind == TriangleFeature::Kind::corner)
    normal = &point_normal_[std::size_t(mesh_.triangles[t][i])];
  // Solids that touch in a corner may have normals there that cancel.
  return *normal == Point{} ? face_normal_[t] : *normal;
}

void MeshSolid::normal(const double x[3], double n[3]) const {
  const NearestPoint near = tree_.nearest(x);
  const Point& on_surface = pseudonormal(near);
  const double distance = std::sqrt(near.square);
  // Nearer than this the difference of x and its foot is all rounding.
  const bool on = distance <= 1e-9 * size_;
  if (on || near.feature.kind == TriangleFeature::Kind::face) {
    std::copy(on_surface.begin(), on_surface.end(), n);
    return;
  }
  const double side = inside(x) ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) n[i] = side * (x[i] - near.point[i]) / distance;
}

}  // namespace scree
