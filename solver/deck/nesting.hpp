// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "solver/base/problems.hpp"

namespace scree {

/// A TOML text whose brackets, braces or dotted keys nest deeper than 100: reading is recursive and
/// would run out of stack. No deck needs more than a dozen. Strings and comments do not count.
std::optional<Problem> nesting_problem(const std::string& text,
                                       const std::shared_ptr<const std::string>& source);

}  // namespace scree
