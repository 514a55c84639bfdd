// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "postproc/run/run.hpp"

namespace scree {

/// What write_colliders has written.
struct ColliderFiles {
  std::size_t colliders = 0, moving = 0, files = 0;
};

/// Writes the colliders of a run as ParaView reads them: `index`, a .pvd file, names the surfaces
/// that belong to each time (s, ascending), which lie in the folder `<stem>_files` beside it. A
/// collider at rest has one file. `done` hears how many times are done. Throws UserError, RunFault.
ColliderFiles write_colliders(const Run& run, const std::vector<double>& times,
                              const std::filesystem::path& index,
                              const std::function<void(std::size_t)>& done = {});

}  // namespace scree
