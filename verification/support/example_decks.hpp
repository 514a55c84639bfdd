// SPDX-License-Identifier: Apache-2.0
//
// The decks of inputs, as tests find them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/element/element_deck.hpp"

namespace scree::testing {

/// The decks in a folder of inputs ("" is inputs itself) and below, sorted.
std::vector<std::filesystem::path> decks_below(const std::string& folder);

/// inputs/element/`name`.toml, which must be right; nothing where this build lacks its law.
std::optional<ElementDeck> element_example(const std::string& name,
                                           const std::vector<std::string>& overrides = {});

}  // namespace scree::testing
