// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "postproc/run/frame_source.hpp"

namespace scree {

/// The frames that particles.pvd lists. Throws UserError.
std::unique_ptr<FrameSource> open_vtu_frames(const std::filesystem::path& folder);

}  // namespace scree
