// SPDX-License-Identifier: Apache-2.0
#include "solver/io/frame_series.hpp"

#include "solver/io/vtk_series.hpp"
#include "solver/io/xdmf_series.hpp"

namespace scree {

std::unique_ptr<FrameSeries> make_frame_series(const std::filesystem::path& run_folder,
                                               const std::string& name, const OutputSpec& spec,
                                               std::size_t expected) {
  if (spec.format == FrameFormat::xdmf) {
    return std::make_unique<XdmfSeries>(run_folder, name, spec.precision,
                                        spec.compression == FrameCompression::deflate, expected);
  }
  return std::make_unique<VtkSeries>(run_folder, name, spec.precision);
}

}  // namespace scree
