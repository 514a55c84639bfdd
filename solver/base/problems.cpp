// SPDX-License-Identifier: Apache-2.0
#include "solver/base/problems.hpp"

#include <algorithm>
#include <cctype>
#include <tuple>

namespace scree {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Damerau-Levenshtein distance restricted to adjacent swaps (optimal string alignment).
int edit_distance(const std::string& a, const std::string& b) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (std::size_t i = 0; i <= n; ++i) d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= m; ++j) d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= n; ++i) {
    for (std::size_t j = 1; j <= m; ++j) {
      const int replace = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[n][m];
}

std::string place(const Position& where) {
  std::string source = where.source ? *where.source : std::string("input");
  if (where.line == 0) return source;
  return source + ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = place(problem.where) + ": ";
  if (!problem.key.empty()) {
    text += problem.key;
    if (!problem.value.empty()) text += " = " + problem.value;
    text += ": ";
  }
  text += problem.message;
  if (!problem.allowed.empty()) text += "; allowed: " + problem.allowed;
  if (!problem.repair.empty()) text += "; " + problem.repair;
  return text;
}

bool Problems::any_under(const std::string& key) const {
  return std::any_of(problems_.begin(), problems_.end(), [&](const Problem& problem) {
    const std::string& other = problem.key;
    const bool starts = other.rfind(key, 0) == 0;
    return starts &&
           (other.size() == key.size() || other[key.size()] == '.' || other[key.size()] == '[');
  });
}

std::vector<Problem> Problems::sorted() const {
  std::vector<Problem> result = problems_;
  // A deck's problems (line > 0) come before those of options.
  const auto rank = [](const Problem& p) {
    return std::make_tuple(p.where.line == 0, p.where.line, p.where.column);
  };
  std::stable_sort(result.begin(), result.end(),
                   [&](const Problem& a, const Problem& b) { return rank(a) < rank(b); });
  return result;
}

std::string Problems::text() const {
  std::vector<std::string> lines;
  for (const Problem& problem : sorted()) {
    std::string line = to_string(problem);
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  // One mistake in three letters is a slip; more is another word.
  const std::string wanted = lower(word);
  std::string best;
  int best_distance = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(wanted, lower(candidate));
    if (distance < best_distance && distance < static_cast<int>(candidate.size())) {
      best = candidate;
      best_distance = distance;
    }
  }
  if (!best.empty() || word.size() < 3) return best;
  // An abbreviation: the only candidate that begins with the word, or the other way round.
  for (const std::string& candidate : candidates) {
    const std::string known = lower(candidate);
    const bool starts =
        known.rfind(wanted, 0) == 0 || (known.size() > 2 && wanted.rfind(known, 0) == 0);
    if (!starts) continue;
    if (!best.empty()) return "";
    best = candidate;
  }
  return best;
}

std::string with_article(const std::string& noun) {
  const bool vowel = !noun.empty() && std::string("aeiou").find(noun[0]) != std::string::npos;
  return (vowel ? "an " : "a ") + noun;
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

}  // namespace scree
