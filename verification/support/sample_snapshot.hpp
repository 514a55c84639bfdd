// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/io/snapshot.hpp"

namespace scree {

/// Values that no two places of a file share, so that a swapped component or particle shows.
inline double sample_value(int field, std::size_t particle, int component) {
  return 1000.0 * field + 10.0 * static_cast<double>(particle) + component + 1.0 / 3.0;
}

/// A snapshot of `count` particles with a scalar, a vector and a tensor field.
inline ParticleSnapshot sample_particles(std::size_t count, double time, int dimension = 3) {
  ParticleSnapshot snapshot;
  snapshot.time = time;
  snapshot.step = 17;
  snapshot.dimension = dimension;
  snapshot.fields = {
      {"velocity", "m/s", 3, {}}, {"stress", "Pa", 9, {}}, {"pressure", "Pa", 1, {}}};
  for (std::size_t p = 0; p < count; ++p) {
    for (int c = 0; c < 3; ++c) {
      snapshot.position.push_back(c < dimension ? sample_value(9, p, c) : 0.0);
    }
    snapshot.id.push_back((std::int64_t{1} << 40) + static_cast<std::int64_t>(p));
    snapshot.material.push_back(static_cast<std::int32_t>(p % 2));
    snapshot.body.push_back(static_cast<std::int32_t>(p % 3));
    for (int f = 0; f < 3; ++f) {
      SnapshotField& field = snapshot.fields[static_cast<std::size_t>(f)];
      for (int c = 0; c < field.components; ++c) field.values.push_back(sample_value(f, p, c));
    }
  }
  return snapshot;
}

/// A lattice of nx * ny * nz nodes with a mass and a velocity.
inline GridSnapshot sample_grid(std::int64_t nx, std::int64_t ny, std::int64_t nz, double time,
                                const char* lattice) {
  GridSnapshot snapshot;
  snapshot.time = time;
  snapshot.lattice = lattice;
  snapshot.spacing = 0.25;
  snapshot.origin[0] = -1.0;
  snapshot.nodes[0] = nx;
  snapshot.nodes[1] = ny;
  snapshot.nodes[2] = nz;
  snapshot.fields = {{"mass", "kg", 1, {}}, {"velocity", "m/s", 3, {}}};
  for (std::int64_t i = 0; i < nx * ny * nz; ++i) {
    for (int f = 0; f < 2; ++f) {
      SnapshotField& field = snapshot.fields[static_cast<std::size_t>(f)];
      for (int c = 0; c < field.components; ++c) {
        field.values.push_back(sample_value(f, static_cast<std::size_t>(i), c));
      }
    }
  }
  return snapshot;
}

}  // namespace scree
