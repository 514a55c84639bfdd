// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/value.hpp"

namespace scree::verify {

/// One parameter of a case: a number or a text.
struct Parameter {
  std::string name;
  std::optional<double> number;
  std::string text;  ///< where it is no number
};

/// The parameters of one run of a case, and what they put into its deck.
///
/// A text of the deck may hold expressions of them in braces: "{10/cells}" alone becomes a number
/// (an integer where it is one), "{kernel}" alone the text of that parameter, and in a longer text,
/// "-{g}*min(t/{2*period}, 1)", the numbers are written in its place. Braces that are meant as such
/// cannot be written.
class Parameters {
 public:
  /// Later ones replace earlier ones of the same name.
  void set(const std::string& name, double number);
  void set(const std::string& name, const std::string& text);

  bool has(const std::string& name) const { return find(name) != nullptr; }
  /// Throws std::logic_error for a name that is not there or that has a text.
  double number(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  const std::vector<Parameter>& all() const { return list_; }

  /// The value of an expression of the numbers; reports to `problems` and returns NaN otherwise.
  double evaluate(const std::string& expression, const Value& where, const std::string& key,
                  Problems& problems) const;
  /// Replaces all braces in the texts of a value and below. Reports wrong ones with their place.
  void fill(Value& value, const std::string& key, Problems& problems) const;

 private:
  const Parameter* find(const std::string& name) const;
  void fill_text(Value& value, const std::string& key, Problems& problems) const;

  std::vector<Parameter> list_;
};

}  // namespace scree::verify
