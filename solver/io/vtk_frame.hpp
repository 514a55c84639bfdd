// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "solver/io/output_spec.hpp"
#include "solver/io/snapshot.hpp"

namespace scree {

/// Writes a VTK XML unstructured grid (.vtu): one vertex cell a particle, arrays in base64 in
/// place, `TimeValue` [s] and `step` as field data, `id`, `material`, `body` and all fields as
/// point data. Points are double in either precision. Values too large for single precision become
/// infinite. The file is written aside and renamed. Throws RunFault (disk full); nothing is left
/// behind then.
void write_particle_frame(const std::filesystem::path& path, const ParticleSnapshot& snapshot,
                          FramePrecision precision);

/// Writes one lattice as VTK XML image data (.vti), as above.
void write_grid_frame(const std::filesystem::path& path, const GridSnapshot& snapshot,
                      FramePrecision precision);

}  // namespace scree
