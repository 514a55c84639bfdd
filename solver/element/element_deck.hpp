// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/schema.hpp"
#include "solver/base/value.hpp"
#include "solver/deck/deck.hpp"
#include "solver/element/path_spec.hpp"

namespace scree {

/// A checked deck of `scree element`: one material and a path, in SI, defaults filled in.
struct ElementDeck {
  std::string path;  ///< of the file
  std::string name;  ///< the file's name without .toml
  std::string title;
  std::vector<MaterialSpec> materials;  ///< exactly one
  PathSpec driven;                      ///< `[path]`
};

const Schema<ElementDeck>& element_schema();

/// Reads a deck and checks everything that can be known without driving the point. `overrides` are
/// KEY=VALUE of --set. Mistakes go to `problems`; when there are any, the deck must not be used.
ElementDeck read_element_deck(const std::string& path, const std::vector<std::string>& overrides,
                              Problems& problems);

/// The same for a deck in memory; `source` names it in messages.
ElementDeck read_element_text(const std::string& text, const std::string& source,
                              const std::vector<std::string>& overrides, Problems& problems);

/// The same for a document that was read already.
ElementDeck read_element_document(Value document, const std::string& source, Problems& problems);

}  // namespace scree
