// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/file_paths.hpp"

#include <filesystem>

namespace scree {
namespace {

void resolve(Value& value, const std::filesystem::path& folder) {
  if (value.key == "file" && value.is(Value::Kind::text) && !value.text.empty())
    value.text = (folder / value.text).lexically_normal().string();
  for (Value& item : value.items) resolve(item, folder);
}

}  // namespace

void resolve_file_paths(Value& document, const std::string& deck_path) {
  std::error_code ignored;
  std::filesystem::path deck = std::filesystem::absolute(deck_path, ignored);
  resolve(document, deck.parent_path());
}

}  // namespace scree
