// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace scree {

/// Adds `post` with all its commands; the one that the user names becomes `action`. `words` are
/// those of the command line; what follows "--" is handed to the command.
void add_post(CLI::App& app, std::function<int()>& action, const std::vector<std::string>& words);

/// The words up to "--".
std::vector<std::string> before_dashes(const std::vector<std::string>& words);

}  // namespace scree
