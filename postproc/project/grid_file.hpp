// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "postproc/project/projection.hpp"

namespace scree {

/// Writes a projection, fields as point data in double precision, `volume` beside them and
/// `TimeValue` [s] as field data. A name in .vti gives the whole grid, where nodes without
/// particles are hidden (vtkGhostType) and zero; one in .vtu only the cells that hold particles.
/// Written aside and renamed. Throws RunFault.
void write_grid_file(const std::string& path, const Projection& projection, double time);

}  // namespace scree
