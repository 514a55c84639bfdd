// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/nesting.hpp"

#include <algorithm>
#include <string_view>

namespace scree {
namespace {

constexpr int deepest = 100;

/// Walks over a TOML text and counts what is open.
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) {}

  /// The place where it gets too deep, or npos.
  std::size_t too_deep() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      count(c);
      if (brackets_ > deepest || dots_ > deepest) return at_;
      ++at_;
    }
    return std::string_view::npos;
  }

 private:
  void count(char c) {
    if (c == '[' || c == '{') ++brackets_;
    // Too many closed ones are the parser's to report.
    if ((c == ']' || c == '}') && brackets_ > 0) --brackets_;
    if (c == '.') ++dots_;
    // Only a key has several dots in a row of names.
    if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots_ = 0;
  }

  /// Moves past a string: one quote, or three that span lines. An unclosed one ends the walk.
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool long_one = text_.substr(at_, 3) == three;
    const std::string_view end = long_one ? std::string_view(three) : text_.substr(at_, 1);
    at_ += end.size();
    while (at_ < text_.size() && text_.substr(at_, end.size()) != end) {
      at_ += quote == '"' && text_[at_] == '\\' ? 2 : 1;
    }
    at_ = std::min(at_ + end.size(), text_.size());
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int brackets_ = 0, dots_ = 0;
};

}  // namespace

std::optional<Problem> nesting_problem(const std::string& text,
                                       const std::shared_ptr<const std::string>& source) {
  const std::size_t place = Walker(text).too_deep();
  if (place == std::string::npos) return std::nullopt;
  Problem problem;
  problem.where.source = source;
  problem.where.line = 1;
  problem.where.column = 1;
  for (std::size_t i = 0; i < place; ++i) {
    const bool next = text[i] == '\n';
    problem.where.line += next ? 1 : 0;
    problem.where.column = next ? 1 : problem.where.column + 1;
  }
  problem.message = "brackets or dotted keys nest too deep";
  problem.allowed = "at most " + std::to_string(deepest) + " levels";
  problem.repair = "close brackets that are open";
  return problem;
}

}  // namespace scree
