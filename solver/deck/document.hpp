// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/value.hpp"

namespace scree {

/// A problem of a whole file or option.
Problem source_problem(const std::shared_ptr<const std::string>& source, std::string message,
                       std::string repair = {});

/// Reads a TOML file with the position of every key and value. Reports an unreadable file or the
/// first syntax error to `problems` and returns nothing then.
std::optional<Value> read_document(const std::string& path, Problems& problems);

/// The same for text; `source` names it in messages.
std::optional<Value> parse_document(const std::string& text, const std::string& source,
                                    Problems& problems);

/// Puts `KEY=VALUE` (dotted key; the value is TOML or else a text) into the document, in place of
/// what stands there.
void apply_override(Value& document, const std::string& assignment, Problems& problems);

}  // namespace scree
