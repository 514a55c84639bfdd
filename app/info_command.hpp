// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// `scree info`: prints version, build, backends, devices and libraries.
int info_command();

}  // namespace scree
