// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/library_versions.hpp"

#include <muParser.h>

#include <toml.hpp>

namespace scree {

std::vector<std::pair<std::string, std::string>> deck_library_versions() {
  const std::string toml = std::to_string(TOML11_VERSION_MAJOR) + "." +
                           std::to_string(TOML11_VERSION_MINOR) + "." +
                           std::to_string(TOML11_VERSION_PATCH);
  return {{"toml11", toml}, {"muParser", mu::Parser().GetVersion(mu::pviBRIEF)}};
}

}  // namespace scree
