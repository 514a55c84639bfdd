// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// Remedy for volumetric locking. none: a particle's law sees its own change of volume; fbar: it
/// sees the mean of its surroundings, formed on the grid (method page, "Volumetric locking").
enum class VolumetricLocking { none, fbar };

}  // namespace scree
