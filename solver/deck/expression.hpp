// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scree {

/// A formula of a deck, e.g. "-9.81*min(t/2,1)". Constant: pi. Operators + - * / ^, comparisons,
/// && || and a ? b : c; functions sin cos tan asin acos atan atan2 sinh cosh tanh exp ln log (both
/// natural) log10 log2 sqrt abs sign rint min max sum avg. Evaluation writes into the object: give
/// each thread its own copy.
class Expression {
 public:
  /// \throws UserError when `text` is no expression of the variables.
  Expression(std::string text, std::vector<std::string> variables);
  Expression(const Expression& other);
  Expression& operator=(const Expression& other);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// The value; `values` are those of the variables in the order of the constructor. May be NaN or
  /// infinite where the formula is undefined.
  double operator()(const double* values) const;

  /// True when no variable occurs.
  bool constant() const;

  const std::string& text() const { return text_; }

  /// What is wrong with the text, with the place, or nothing.
  static std::optional<std::string> fault(const std::string& text,
                                          const std::vector<std::string>& variables);

 private:
  struct Parser;
  std::string text_;
  std::vector<std::string> variables_;
  std::unique_ptr<Parser> parser_;
};

}  // namespace scree
