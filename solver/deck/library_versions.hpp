// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scree {

/// Name and version of the libraries that read decks (toml11, muParser).
std::vector<std::pair<std::string, std::string>> deck_library_versions();

}  // namespace scree
