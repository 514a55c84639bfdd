// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/parameters.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "solver/deck/expression.hpp"

namespace scree::verify {
namespace {

void report(const Value& where, const std::string& key, const std::string& message,
            const std::string& allowed, Problems& problems) {
  problems.add({where.position, key, to_toml(where), message, allowed, ""});
}

/// Makes a number of a value, in place of what it was.
void make_number(Value& value, double number) {
  const bool whole = std::abs(number) < 1e15 && number == std::rint(number);
  value.kind = whole ? Value::Kind::integer : Value::Kind::real;
  value.integer = whole ? static_cast<std::int64_t>(number) : 0;
  value.real = number;
  value.text = whole ? std::to_string(value.integer) : toml_number(number);
}

}  // namespace

const Parameter* Parameters::find(const std::string& name) const {
  for (const Parameter& parameter : list_) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

void Parameters::set(const std::string& name, double number) {
  for (Parameter& known : list_) {
    if (known.name == name) {
      known = {name, number, ""};
      return;
    }
  }
  list_.push_back({name, number, ""});
}

void Parameters::set(const std::string& name, const std::string& text) {
  for (Parameter& known : list_) {
    if (known.name == name) {
      known = {name, std::nullopt, text};
      return;
    }
  }
  list_.push_back({name, std::nullopt, text});
}

double Parameters::number(const std::string& name) const {
  const Parameter* const parameter = find(name);
  if (parameter == nullptr || !parameter->number)
    throw std::logic_error("the case has no number \"" + name + "\" in sweep.parameters");
  return *parameter->number;
}

const std::string& Parameters::text(const std::string& name) const {
  const Parameter* const parameter = find(name);
  if (parameter == nullptr || parameter->number)
    throw std::logic_error("the case has no text \"" + name + "\" in sweep.parameters");
  return parameter->text;
}

double Parameters::evaluate(const std::string& expression, const Value& where,
                            const std::string& key, Problems& problems) const {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const Parameter& parameter : list_) {
    if (!parameter.number) continue;
    names.push_back(parameter.name);
    values.push_back(*parameter.number);
  }
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (const auto fault = Expression::fault(expression, names)) {
    report(where, key, "{" + expression + "} " + *fault, "parameters: " + join(names), problems);
    return nothing;
  }
  const double result = Expression(expression, names)(values.data());
  if (!std::isfinite(result))
    report(where, key, "{" + expression + "} is not finite", "", problems);
  return result;
}

void Parameters::fill(Value& value, const std::string& key, Problems& problems) const {
  if (value.is(Value::Kind::text)) fill_text(value, key, problems);
  for (Value& item : value.items) {
    const std::string below = value.is(Value::Kind::array) ? key
                              : key.empty()                ? item.key
                                                           : key + "." + item.key;
    fill(item, below, problems);
  }
}

void Parameters::fill_text(Value& value, const std::string& key, Problems& problems) const {
  const std::string text = value.text;
  std::string result;
  std::size_t from = 0;
  while (true) {
    const std::size_t open = text.find('{', from);
    if (open == std::string::npos) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) {
      report(value, key, "a { without its }", "", problems);
      return;
    }
    const std::string inside = text.substr(open + 1, close - open - 1);
    const bool alone = open == 0 && close + 1 == text.size();
    const Parameter* const named = find(inside);
    result += text.substr(from, open - from);
    if (named != nullptr && !named->number) {
      result += named->text;
    } else {
      const double number = evaluate(inside, value, key, problems);
      if (alone) return make_number(value, number);
      // In an expression a negative number needs its own parentheses.
      result += number < 0 ? "(" + toml_number(number) + ")" : toml_number(number);
    }
    from = close + 1;
  }
  value.text = result + text.substr(from);
}

}  // namespace scree::verify
