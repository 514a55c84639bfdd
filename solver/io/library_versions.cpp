// SPDX-License-Identifier: Apache-2.0
#include "solver/io/library_versions.hpp"

#include <hdf5.h>
#include <vtkVersion.h>

namespace scree {

std::vector<std::pair<std::string, std::string>> io_library_versions() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  const std::string hdf5 =
      std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
  return {{"VTK", vtkVersion::GetVTKVersion()}, {"HDF5", hdf5}};
}

}  // namespace scree
