// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/base/value.hpp"

namespace scree {

/// A path of keys as a deck writes it: body."left block".shape.
inline std::string key_text(const std::vector<std::string>& path) {
  std::string key;
  for (const std::string& part : path) key += (key.empty() ? "" : ".") + toml_key(part);
  return key;
}

}  // namespace scree
