// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace scree {

/// The values of a resolved deck: dotted key -> value as text, without comments.
std::map<std::string, std::string> deck_values(const std::string& resolved_toml);

/// The keys whose values differ between two resolved decks and that a continued run must not
/// change, each as "key = new (was old)". Free to change are the title, the precision of the
/// frames, and a later end.
std::vector<std::string> forbidden_changes(const std::string& former_toml,
                                           const std::string& current_toml);

}  // namespace scree
