// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "postproc/run/frame_source.hpp"

namespace scree {

/// The frames that the index particles.xdmf names, in particles.h5. Throws UserError.
std::unique_ptr<FrameSource> open_xdmf_frames(const std::filesystem::path& folder);

}  // namespace scree
