// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string>
#include <string_view>

namespace scree {

/// Splits a text into words at white space and counts its lines; the text must outlive it.
class WordReader {
 public:
  explicit WordReader(std::string_view text) : text_(text) {}

  /// The next word, empty at the end.
  std::string_view next() {
    skip([](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
    return word();
  }
  /// The next word of this line, empty at the line's end.
  std::string_view next_in_line() {
    skip([](char c) { return c != '\n' && std::isspace(static_cast<unsigned char>(c)) != 0; });
    return word();
  }
  /// What is left of this line, without the spaces around it; then the next line begins.
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    skip_line_end();
    while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.front())))
      rest.remove_prefix(1);
    while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.back())))
      rest.remove_suffix(1);
    return rest;
  }
  bool at_end() const { return at_ >= text_.size(); }
  long line() const { return line_; }  ///< from 1

  /// Reads a number with a point as its decimal sign; false if the word is not one as a whole.
  template <class T>
  static bool number(std::string_view word, T& value) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    return fault == std::errc() && end == word.data() + word.size();
  }

 private:
  template <class F>
  void skip(F unwanted) {
    while (at_ < text_.size() && unwanted(text_[at_])) {
      if (text_[at_] == '\n') ++line_;
      ++at_;
    }
  }
  void skip_line_end() {
    if (at_ >= text_.size()) return;
    ++at_;
    ++line_;
  }
  std::string_view word() {
    const std::size_t first = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return text_.substr(first, at_ - first);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  long line_ = 1;
};

}  // namespace scree
