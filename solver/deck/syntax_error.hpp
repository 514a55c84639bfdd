// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "solver/base/problems.hpp"

namespace scree {

/// Turns the message of toml11's parser (several lines with a drawing of the place) into a problem
/// with line, column and one sentence. The place comes from the drawing, because the exception's
/// own is often that of the document's begin.
Problem syntax_problem(const std::string& message,
                       const std::shared_ptr<const std::string>& source);

}  // namespace scree
