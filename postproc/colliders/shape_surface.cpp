// SPDX-License-Identifier: Apache-2.0
#include "postproc/colliders/shape_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/particles/shape_heightmap.hpp"
#include "solver/particles/shape_mesh.hpp"

namespace scree {
namespace {

using Point = SurfaceMesh::Point;
constexpr int sides = 96;

SurfaceMesh::Cell in_order(std::int64_t first, std::size_t count) {
  SurfaceMesh::Cell cell(count);
  std::iota(cell.begin(), cell.end(), first);
  return cell;
}

/// One polygon; in 2D with its outline.
SurfaceMesh polygon_mesh(const std::vector<Point>& corners, bool outline) {
  SurfaceMesh mesh;
  if (corners.size() < 3) return mesh;
  mesh.polygons.push_back(in_order(mesh.add(corners), corners.size()));
  if (!outline) return mesh;
  mesh.lines.push_back(mesh.polygons.front());
  mesh.lines.front().push_back(0);
  return mesh;
}

/// The solid between a polygon and its copy moved by `along`.
SurfaceMesh prism(const std::vector<Point>& base, const Point& along) {
  SurfaceMesh mesh;
  const auto n = static_cast<std::int64_t>(base.size());
  std::vector<Point> top = base;
  for (Point& x : top)
    for (std::size_t a = 0; a < 3; ++a) x[a] += along[a];
  mesh.add(base);
  mesh.add(top);
  mesh.polygons = {in_order(0, base.size()), in_order(n, base.size())};
  for (std::int64_t i = 0; i < n; ++i)
    mesh.polygons.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  return mesh;
}

std::vector<Point> rectangle(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  return {{low[0], low[1], low[2]},
          {high[0], low[1], low[2]},
          {high[0], high[1], low[2]},
          {low[0], high[1], low[2]}};
}

/// Two unit vectors across a direction.
std::array<Point, 2> across(const Point& direction) {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  Point n = direction;
  for (double& x : n) x /= length;
  Point least{};  // the axis farthest from the direction
  least[static_cast<std::size_t>(
      std::min_element(n.begin(), n.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      n.begin())] = 1;
  const auto cross = [](const Point& a, const Point& b) {
    return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  Point u = cross(n, least);
  const double size = std::hypot(u[0], u[1], u[2]);
  for (double& x : u) x /= size;
  return {u, cross(n, u)};
}

std::vector<Point> circle(const Point& center, double radius, const Point& u, const Point& v) {
  std::vector<Point> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    Point x;
    for (std::size_t a = 0; a < 3; ++a)
      x[a] = center[a] + radius * (std::cos(angle) * u[a] + std::sin(angle) * v[a]);
    points.push_back(x);
  }
  return points;
}

SurfaceMesh sphere(const ShapeSpec& spec) {
  SurfaceMesh mesh;
  constexpr int rings = sides / 2;
  for (int k = 0; k <= rings; ++k) {
    const double angle = std::numbers::pi * k / rings;
    Point center = spec.center;
    center[2] += spec.radius * std::cos(angle);
    mesh.add(circle(center, spec.radius * std::sin(angle), {1, 0, 0}, {0, 1, 0}));
  }
  for (std::int64_t k = 0; k < rings; ++k) {
    for (std::int64_t i = 0; i < sides; ++i) {
      const std::int64_t next = (i + 1) % sides;
      mesh.polygons.push_back(
          {k * sides + i, k * sides + next, (k + 1) * sides + next, (k + 1) * sides + i});
    }
  }
  return mesh;
}

SurfaceMesh cylinder(const ShapeSpec& spec, int dimension) {
  Point along;
  for (std::size_t a = 0; a < 3; ++a) along[a] = spec.to[a] - spec.from[a];
  if (dimension == 3) {
    const auto [u, v] = across(along);
    return prism(circle(spec.from, spec.radius, u, v), along);
  }
  const double length = std::hypot(along[0], along[1]);
  const Point side{-along[1] / length * spec.radius, along[0] / length * spec.radius, 0};
  std::vector<Point> corners;
  for (const auto& [end, sign] :
       {std::pair{spec.from, -1}, {spec.to, -1}, {spec.to, 1}, {spec.from, 1}})
    corners.push_back({end[0] + sign * side[0], end[1] + sign * side[1], 0});
  return polygon_mesh(corners, true);
}

SurfaceMesh polygon(const ShapeSpec& spec, int dimension) {
  std::vector<Point> corners;
  for (const auto& p : spec.points) corners.push_back({p[0], p[1], dimension == 3 ? spec.z[0] : 0});
  return dimension == 3 ? prism(corners, {0, 0, spec.z[1] - spec.z[0]})
                        : polygon_mesh(corners, true);
}

/// The part within the domain: in 2D of the half plane, in 3D of the plane itself.
SurfaceMesh plane(const ShapeSpec& spec, int dimension, const Box& domain) {
  if (dimension == 2) {
    return polygon_mesh(cut_polygon(rectangle(domain.lower, domain.upper), spec.point, spec.normal),
                        true);
  }
  const auto [u, v] = across(spec.normal);
  double reach = 0;  // beyond the domain on all sides
  for (std::size_t a = 0; a < 3; ++a)
    reach += std::max(std::abs(domain.lower[a] - spec.point[a]),
                      std::abs(domain.upper[a] - spec.point[a]));
  std::vector<Point> corners;
  for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Point x;
    for (std::size_t a = 0; a < 3; ++a) x[a] = spec.point[a] + reach * (s * u[a] + t * v[a]);
    corners.push_back(x);
  }
  for (std::size_t a = 0; a < 3; ++a) {
    Point outward{};
    outward[a] = 1;
    corners = cut_polygon(corners, domain.upper, outward);
    outward[a] = -1;
    corners = cut_polygon(corners, domain.lower, outward);
  }
  return polygon_mesh(corners, false);
}

SurfaceMesh terrain(const HeightRaster& raster) {
  constexpr int most = 1000;
  const int step = (std::max(raster.columns(), raster.rows()) + most - 1) / most;
  // From rim to rim: the outermost heights reach half a cell outward.
  const auto places = [&](int count, std::size_t a) {
    std::vector<double> x{raster.lower()[a]};
    for (int i = 0; i < count; i += step) x.push_back(raster.center()[a] + i * raster.cell_size());
    x.push_back(raster.upper()[a]);
    return x;
  };
  const std::vector<double> xs = places(raster.columns(), 0), ys = places(raster.rows(), 1);
  SurfaceMesh mesh;
  for (const double y : ys)
    for (const double x : xs) mesh.points.push_back({x, y, raster.height(x, y)});
  const auto width = static_cast<std::int64_t>(xs.size());
  for (std::int64_t j = 0; j + 1 < static_cast<std::int64_t>(ys.size()); ++j) {
    for (std::int64_t i = 0; i + 1 < width; ++i) {
      const std::int64_t corner = j * width + i;
      mesh.polygons.push_back({corner, corner + 1, corner + width + 1, corner + width});
    }
  }
  return mesh;
}

SurfaceMesh triangles(const TriangleMesh& file) {
  SurfaceMesh mesh;
  mesh.points = file.points;
  for (const auto& triangle : file.triangles)
    mesh.polygons.emplace_back(triangle.begin(), triangle.end());
  return mesh;
}

/// What the domain and the shape have in common, a little beyond the domain.
Box common_box(const Box& shape, const Box& domain, int dimension) {
  Box box;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    const double margin = 0.05 * (domain.upper[a] - domain.lower[a]);
    box.lower[a] = std::max(shape.lower[a], domain.lower[a] - margin);
    box.upper[a] = std::min(shape.upper[a], domain.upper[a] + margin);
    if (!(box.lower[a] < box.upper[a])) return {};
  }
  return box;
}

}  // namespace

SurfaceMesh shape_surface(const ShapeSpec& spec, int dimension, const Box& domain) {
  const std::unique_ptr<Shape> shape = make_shape(spec, dimension);
  if (spec.kind == ShapeKind::plane) return plane(spec, dimension, domain);
  if (spec.kind == ShapeKind::cylinder) return cylinder(spec, dimension);
  if (spec.kind == ShapeKind::polygon) return polygon(spec, dimension);
  if (spec.kind == ShapeKind::box) {
    const std::vector<Point> base = rectangle(spec.lower, spec.upper);
    return dimension == 3 ? prism(base, {0, 0, spec.upper[2] - spec.lower[2]})
                          : polygon_mesh(base, true);
  }
  if (spec.kind == ShapeKind::sphere) {
    return dimension == 3
               ? sphere(spec)
               : polygon_mesh(circle(spec.center, spec.radius, {1, 0, 0}, {0, 1, 0}), true);
  }
  if (const auto* mesh = dynamic_cast<const MeshShape*>(shape.get()))
    return triangles(mesh->solid().mesh());
  if (const auto* ground = dynamic_cast<const TerrainShape*>(shape.get()))
    return terrain(ground->raster());
  const Box box = common_box(shape->bounds(), domain, dimension);
  if (!(box.lower[0] < box.upper[0])) return {};
  return dimension == 3 ? contour_3d(*shape, box, 96) : contour_2d(*shape, box, 800);
}

}  // namespace scree
