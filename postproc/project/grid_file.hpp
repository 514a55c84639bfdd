// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "postproc/project/projection.hpp"

namespace scree {

/// Writes a projection, fields as point data in double precision, `volume` beside them and
/// `TimeValue` [s] as field data. A name in .vti gives the whole grid, where nodes without
/// particles are hidden (vtkGhostType) and zero; one in .vtu or .xdmf only the cells that hold
/// particles; .xdmf is an index of arrays in an HDF5 file of the same name that ends in .h5.
/// Written aside and renamed. Throws RunFault.
void write_grid_file(const std::string& path, const Projection& projection, double time);

/// The .xdmf alone; in write_grid_file for others.
void write_xdmf_grid(const std::string& path, const Projection& projection, double time);

}  // namespace scree
