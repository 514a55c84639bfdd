// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/device/device_array.hpp"
#include "solver/device/kernels.hpp"
#include "solver/grid/face_pairs.hpp"

namespace scree {

/// The pairs of nodes that the faces of one axis act on, on a device, grouped by the lines of nodes
/// along the axis: a ghost and its image lie on one line, so lines are independent, and along a
/// line pairs keep their order.
class FaceLines {
 public:
  explicit FaceLines(Device& device)
      : begin_(device, "faces"),
        ghost_(device, "faces"),
        image_(device, "faces"),
        side_(device, "faces"),
        folded_(device, "faces") {}

  template <int D, class T>
  void build(const Grid<D, T>& grid, const std::vector<FacePair>& pairs, int axis);

  /// axis, types and friction are the caller's to fill in.
  FoldLines view() const {
    FoldLines lines;
    lines.line_begin = begin_.data();
    lines.lines = std::int32_t(begin_.size()) - 1;
    lines.ghost = ghost_.data();
    lines.image = image_.data();
    lines.side = side_.data();
    lines.folded = folded_.data();
    return lines;
  }
  bool empty() const { return ghost_.size() == 0; }
  std::int64_t bytes() const {
    return std::int64_t(begin_.bytes() + ghost_.bytes() + image_.bytes() + side_.bytes() +
                        folded_.bytes());
  }

 private:
  DeviceArray<std::int32_t> begin_;
  DeviceArray<std::int64_t> ghost_;
  DeviceArray<std::int64_t> image_;
  DeviceArray<std::int32_t> side_;
  DeviceArray<std::int8_t> folded_;
};

}  // namespace scree
