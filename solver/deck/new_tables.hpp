// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/problems.hpp"
#include "solver/base/schema.hpp"
#include "solver/base/value.hpp"

namespace scree {

/// A table such as [material.NAME] that only --set made, and that lacks required keys, has a wrong
/// name rather than missing keys. Reports it with the names of the deck (`original`: the document
/// before --set) and removes it, so that nothing else is said about it.
void refuse_incomplete_tables(Value& document, const Value& original, const SchemaBase& schema,
                              Problems& problems);

}  // namespace scree
