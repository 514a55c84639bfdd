// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/surface.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

namespace {

using Site = std::array<std::int64_t, 3>;

/// Part of a spacing within which a face counts as lying on a rim or wall.
constexpr double touch = 1e-6;

SiteSet filled_sites(const SampledBody& body) {
  Site first{}, last{};
  for (std::int64_t p = 0; p < body.count(); ++p) {
    const Site site = body.lattice.site(&body.position[3 * static_cast<std::size_t>(p)]);
    for (int a = 0; a < 3; ++a) {
      first[a] = p == 0 ? site[a] : std::min(first[a], site[a]);
      last[a] = p == 0 ? site[a] : std::max(last[a], site[a]);
    }
  }
  Site count;
  for (int a = 0; a < 3; ++a) count[a] = last[a] - first[a] + 1;
  SiteSet filled(first, count);
  for (std::int64_t p = 0; p < body.count(); ++p) {
    const Site site = body.lattice.site(&body.position[3 * static_cast<std::size_t>(p)]);
    filled.insert(site[0], site[1], site[2]);
  }
  return filled;
}

bool faces_the_right_way(const SurfaceSelection& selection, int axis, int sign) {
  const auto& f = selection.facing;
  const double size = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  return size == 0 || sign * f[axis] > 0.5 * size;
}

bool selected(const SurfaceSelection& selection, const SampledBody& body, const double* x, int axis,
              int sign) {
  if (!faces_the_right_way(selection, axis, sign)) return false;
  double center[3] = {x[0], x[1], x[2]};
  center[axis] += 0.5 * sign * body.spacing;
  const double tolerance = touch * body.spacing;
  const double wall = sign < 0 ? body.lattice.lower[axis] : selection.domain_upper[axis];
  if (selection.wall[axis][sign < 0 ? 0 : 1] && std::abs(center[axis] - wall) < tolerance)
    return false;
  return !selection.region || selection.region->signed_distance(center) <= tolerance;
}

}  // namespace

std::vector<SurfaceFace> single_faces(const SampledBody& body, const SurfaceSelection& selection) {
  std::vector<SurfaceFace> faces;
  if (body.count() == 0) return faces;
  const SiteSet filled = filled_sites(body);
  for (std::int64_t p = 0; p < body.count(); ++p) {
    const double* x = &body.position[3 * static_cast<std::size_t>(p)];
    const Site site = body.lattice.site(x);
    for (int axis = 0; axis < body.lattice.dimension; ++axis) {
      for (int sign = -1; sign <= 1; sign += 2) {
        Site next = site;
        next[axis] += sign;
        if (filled.contains(next[0], next[1], next[2])) continue;
        if (selected(selection, body, x, axis, sign)) faces.push_back({p, axis, sign});
      }
    }
  }
  return faces;
}

SurfacePatch exposed_faces(const SampledBody& body, const SurfaceSelection& selection) {
  SurfacePatch patch;
  if (body.count() == 0) return patch;
  const double face = std::pow(body.spacing, body.lattice.dimension - 1);
  const std::vector<SurfaceFace> faces = single_faces(body, selection);
  for (std::size_t i = 0; i < faces.size();) {
    const std::int64_t p = faces[i].particle;
    double sum[3] = {0, 0, 0}, square = 0;
    for (; i < faces.size() && faces[i].particle == p;) {
      const int axis = faces[i].axis;
      int number = 0;
      for (; i < faces.size() && faces[i].particle == p && faces[i].axis == axis; ++i, ++number) {
        sum[axis] += faces[i].sign * face;
      }
      square += number * number;
    }
    patch.particle.push_back(p);
    patch.area_vector.insert(patch.area_vector.end(), sum, sum + 3);
    patch.area.push_back(face * std::sqrt(square));
  }
  return patch;
}

}  // namespace scree
