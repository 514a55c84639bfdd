// SPDX-License-Identifier: Apache-2.0
#include "verification/support/example_decks.hpp"

#include <algorithm>

namespace scree::testing {

namespace fs = std::filesystem;

std::vector<fs::path> decks_below(const std::string& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(SCREE_SOURCE_DIR) / "inputs" / folder)) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::optional<ElementDeck> element_example(const std::string& name,
                                           const std::vector<std::string>& overrides) {
  Problems problems;
  const std::string path = std::string(SCREE_SOURCE_DIR) + "/inputs/element/" + name + ".toml";
  const ElementDeck deck = read_element_deck(path, overrides, problems);
  const std::string text = problems.text();
  if (text.find("not available in this") != std::string::npos) return std::nullopt;
  EXPECT_EQ(text, "");
  if (!problems.empty()) return std::nullopt;
  return deck;
}

}  // namespace scree::testing
