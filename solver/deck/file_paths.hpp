// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "solver/base/value.hpp"

namespace scree {

/// Makes the relative paths under the key `file` of all tables absolute: they start at the folder
/// of the deck at `deck_path`.
void resolve_file_paths(Value& document, const std::string& deck_path);

}  // namespace scree
