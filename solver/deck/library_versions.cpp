// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/library_versions.hpp"

#include <muParser.h>

#include <toml.hpp>

namespace scree {

std::vector<std::pair<std::string, std::string>> deck_library_versions() {
  const std::string toml = std::to_string(TOML11_VERSION_MAJOR) + "." +
                           std::to_string(TOML11_VERSION_MINOR) + "." +
                           std::to_string(TOML11_VERSION_PATCH);
  // "2.3.3 (Release)"
  const std::string parser = mu::Parser().GetVersion(mu::pviBRIEF);
  return {{"toml11", toml}, {"muParser", parser.substr(0, parser.find(' '))}};
}

}  // namespace scree
