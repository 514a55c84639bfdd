// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scree {

/// Name and version of the libraries that write and read files (VTK, HDF5).
std::vector<std::pair<std::string, std::string>> io_library_versions();

}  // namespace scree
