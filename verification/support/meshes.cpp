// SPDX-License-Identifier: Apache-2.0
#include "verification/support/meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace scree::testing {
namespace {

using Point = TriangleMesh::Point;

void add_quadrangle(TriangleMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

Point on_sphere(const Point& p, double radius) {
  const double scale = radius / std::hypot(p[0], p[1], p[2]);
  return {scale * p[0], scale * p[1], scale * p[2]};
}

void quarter(TriangleMesh& mesh, double radius) {
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [entry, fresh] = middles.insert({std::minmax(i, j), int(mesh.points.size())});
    if (fresh) {
      const Point p = mesh.points[std::size_t(i)], q = mesh.points[std::size_t(j)];
      mesh.points.push_back(on_sphere({p[0] + q[0], p[1] + q[1], p[2] + q[2]}, radius));
    }
    return entry->second;
  };
  std::vector<TriangleMesh::Triangle> fine;
  for (const auto& t : mesh.triangles) {
    const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    for (const TriangleMesh::Triangle& part :
         {TriangleMesh::Triangle{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}})
      fine.push_back(part);
  }
  mesh.triangles = std::move(fine);
}

void put(std::string& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(char((value >> (8 * i)) & 0xff));
}

}  // namespace

TriangleMesh box_mesh(const std::array<double, 3>& lower, const std::array<double, 3>& upper) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(
        {i & 1 ? upper[0] : lower[0], i & 2 ? upper[1] : lower[1], i & 4 ? upper[2] : lower[2]});
  add_quadrangle(mesh, 0, 2, 3, 1);
  add_quadrangle(mesh, 4, 5, 7, 6);
  add_quadrangle(mesh, 0, 1, 5, 4);
  add_quadrangle(mesh, 2, 6, 7, 3);
  add_quadrangle(mesh, 0, 4, 6, 2);
  add_quadrangle(mesh, 1, 3, 7, 5);
  return mesh;
}

TriangleMesh icosphere(double radius, int levels) {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  for (const double s : {-1.0, 1.0})
    for (const double t : {-g, g}) {
      mesh.points.push_back({0, s, t});
      mesh.points.push_back({s, t, 0});
      mesh.points.push_back({t, 0, s});
    }
  // Faces: any three points at the distance 2 of each other, turned outward.
  const auto near = [&](int i, int j) {
    const Point &p = mesh.points[std::size_t(i)], &q = mesh.points[std::size_t(j)];
    return std::abs(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) - 2) < 1e-9;
  };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const Point &p = mesh.points[std::size_t(i)], &q = mesh.points[std::size_t(j)],
                    &r = mesh.points[std::size_t(k)];
        const double volume = p[0] * (q[1] * r[2] - q[2] * r[1]) +
                              p[1] * (q[2] * r[0] - q[0] * r[2]) +
                              p[2] * (q[0] * r[1] - q[1] * r[0]);
        if (volume > 0) mesh.triangles.push_back({i, j, k});
        if (volume < 0) mesh.triangles.push_back({i, k, j});
      }
  for (Point& p : mesh.points) p = on_sphere(p, radius);
  for (int level = 0; level < levels; ++level) quarter(mesh, radius);
  return mesh;
}

TriangleMesh torus_mesh(double ring, double tube, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = ring + tube * std::cos(v);
      mesh.points.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j)
      add_quadrangle(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return mesh;
}

TriangleMesh sheet_mesh(const std::array<double, 2>& lower, const std::array<double, 2>& upper,
                        double z, int count) {
  TriangleMesh mesh;
  for (int j = 0; j <= count; ++j)
    for (int i = 0; i <= count; ++i)
      mesh.points.push_back({lower[0] + (upper[0] - lower[0]) * i / count,
                             lower[1] + (upper[1] - lower[1]) * j / count, z});
  const int row = count + 1;
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i)
      add_quadrangle(mesh, j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i);
  return mesh;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const int shift = int(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

std::string ascii_stl(const TriangleMesh& mesh, const std::string& name) {
  std::string text = "solid " + name + "\n";
  for (const auto& t : mesh.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int i : t) {
      const Point& p = mesh.points[std::size_t(i)];
      text += fmt::format("   vertex {} {} {}\n", p[0], p[1], p[2]);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

std::string binary_stl(const TriangleMesh& mesh, const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  put(bytes, std::uint32_t(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(bytes, 0);
    for (const int i : t)
      for (const double x : mesh.points[std::size_t(i)])
        put(bytes, std::bit_cast<std::uint32_t>(float(x)));
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text = "# a comment\no part\n";
  for (const Point& p : mesh.points) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles)
    text += fmt::format("f {}//1 {}/2/3 {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string ply_text(const TriangleMesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty "
      "float "
      "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.points.size(), mesh.triangles.size());
  for (const Point& p : mesh.points) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace scree::testing
