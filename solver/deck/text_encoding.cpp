// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/text_encoding.hpp"

#include <algorithm>
#include <cstdio>

namespace scree {
namespace {

/// Bytes of the character that begins with this one; 0: none begins so.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  if (first < 0xE0) return 2;
  if (first < 0xF0) return 3;
  return first < 0xF5 ? 4 : 0;
}

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The first byte that belongs to no character, or the length of the text.
std::size_t first_wrong_byte(const std::string& text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t length = length_of(static_cast<unsigned char>(text[i]));
    if (length == 0 || i + length > text.size()) return i;
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(i);
    if (!std::all_of(begin + 1, begin + static_cast<std::ptrdiff_t>(length), continues)) return i;
    i += length;
  }
  return i;
}

}  // namespace

std::optional<Problem> encoding_problem(const std::string& text,
                                        const std::shared_ptr<const std::string>& source) {
  Problem problem;
  problem.where.source = source;
  problem.repair = "save the deck as UTF-8";
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    problem.message = "is UTF-16 text";
    return problem;
  }
  const std::size_t wrong = first_wrong_byte(text);
  if (wrong == text.size()) return std::nullopt;
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(wrong);
  problem.where.line = 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
  const std::size_t line_end = wrong == 0 ? std::string::npos : text.rfind('\n', wrong - 1);
  const std::size_t line_begin = line_end == std::string::npos ? 0 : line_end + 1;
  problem.where.column = static_cast<int>(wrong - line_begin) + 1;
  char byte[8];
  std::snprintf(byte, sizeof byte, "0x%02X", static_cast<unsigned char>(text[wrong]));
  problem.message = std::string("has a byte that is not UTF-8, ") + byte;
  return problem;
}

}  // namespace scree
