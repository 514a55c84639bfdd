// SPDX-License-Identifier: Apache-2.0
#include "postproc/run/frame_source.hpp"

#include <cmath>

#include "postproc/run/vtu_frames.hpp"
#include "postproc/run/xdmf_frames.hpp"
#include "solver/base/error.hpp"

namespace scree {

std::unique_ptr<FrameSource> open_frames(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::exists(folder / "particles.pvd", ignored)) return open_vtu_frames(folder);
  if (std::filesystem::exists(folder / "particles.xdmf", ignored)) return open_xdmf_frames(folder);
  throw UserError(
      folder.string() +
      " holds no particle frames (no particles.pvd or particles.xdmf); a run with output.format = "
      "\"none\" has none, and a fresh one writes its first at t = 0");
}

std::size_t nearest_frame(const FrameSource& frames, double time) {
  const std::vector<double>& times = frames.times();
  std::size_t best = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (std::abs(times[i] - time) < std::abs(times[best] - time)) best = i;
  }
  return best;
}

}  // namespace scree
