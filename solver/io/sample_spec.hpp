// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/schema.hpp"
#include "solver/particles/shape_spec.hpp"

namespace scree {

/// What all recorders of samples have: when they add rows to their table, and of which fields.
struct SampleSpec {
  std::string name;
  double every = std::numeric_limits<double>::quiet_NaN();  ///< s; default history.every
  std::vector<std::string> fields;
};

enum class ProbeType { point, particle };

/// `[probe.NAME]`: one row at a time, of a place or of a particle.
struct ProbeSpec : SampleSpec {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  ProbeType type = ProbeType::point;
  std::array<double, 3> at{none, none, none};  ///< m
  /// m, point: particles nearer than this count, with a weight that falls linearly to 0 there.
  double radius = none;      ///< default domain.cell_size
  std::optional<double> id;  ///< particle: its number; none: the nearest to `at` at t = 0
};

/// `[profile.NAME]`: means over bins along a line.
struct ProfileSpec : SampleSpec {
  std::array<double, 3> from{}, to{};  ///< m
  int bins = 50;
  double radius = std::numeric_limits<double>::quiet_NaN();  ///< m; default domain.cell_size
};

enum class SectionNormal { x, y, z };

/// `[section.NAME]`: means over square bins in a plane; in 2D the plane of the run.
struct SectionSpec : SampleSpec {
  SectionNormal normal = SectionNormal::z;
  double position = 0;                                          ///< m along the normal; 3D
  double spacing = std::numeric_limits<double>::quiet_NaN();    ///< m; default domain.cell_size
  double thickness = std::numeric_limits<double>::quiet_NaN();  ///< m, 3D; default spacing
  std::optional<ShapeSpec> region;
};

const Schema<ProbeSpec>& probe_schema();
const Schema<ProfileSpec>& profile_schema();
const Schema<SectionSpec>& section_schema();

}  // namespace scree
