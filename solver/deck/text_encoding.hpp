// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "solver/base/problems.hpp"

namespace scree {

/// What is wrong where a text is not UTF-8 (a deck saved as UTF-16 or Latin-1), with the place of
/// its first wrong byte; nothing where it is. Overlong forms are the parser's to find.
std::optional<Problem> encoding_problem(const std::string& text,
                                        const std::shared_ptr<const std::string>& source);

}  // namespace scree
