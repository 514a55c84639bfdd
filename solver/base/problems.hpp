// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

/// What is wrong with a user's input: collected, sorted by position, reported all at once.
namespace scree {

/// A place in a deck. `line` 0 means that only the source is known (e.g. a --set option).
struct Position {
  std::shared_ptr<const std::string> source;  ///< file name or "--set key=value"
  int line = 0;                               ///< from 1
  int column = 0;                             ///< from 1, in bytes
};

/// One mistake, with everything the user needs to mend it. Empty parts are not printed.
struct Problem {
  Position where;
  std::string key;      ///< dotted path, e.g. "body.column.shape.radius"
  std::string value;    ///< as written
  std::string message;  ///< what is wrong
  std::string allowed;  ///< what would be right
  std::string repair;   ///< what to do
};

/// `file:line:col: key = value: what is wrong; allowed; repair`
std::string to_string(const Problem& problem);

/// All mistakes of one deck.
class Problems {
 public:
  void add(Problem problem) { problems_.push_back(std::move(problem)); }
  bool empty() const { return problems_.empty(); }
  std::size_t size() const { return problems_.size(); }
  /// Whether a problem is about `key` or a key below it.
  bool any_under(const std::string& key) const;
  /// In the order of their positions: the deck's first, then those of options.
  std::vector<Problem> sorted() const;
  /// One line a problem, sorted, without repetitions, each ended by a newline.
  std::string text() const;

 private:
  std::vector<Problem> problems_;
};

/// The candidate nearest to `word` by edit distance (insertions, deletions, replacements, swaps of
/// neighbours; case ignored), or "" when none is near enough to be meant.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// "a number", "an angle"
std::string with_article(const std::string& noun);

/// "a, b, c"
std::string join(const std::vector<std::string>& words, const std::string& separator = ", ");

}  // namespace scree
