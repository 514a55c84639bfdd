// SPDX-License-Identifier: Apache-2.0
#include "solver/deck/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <numbers>

#include "solver/base/error.hpp"
#include "solver/base/problems.hpp"
#include "solver/deck/quiet_floats.hpp"

namespace scree {

struct Expression::Parser {
  mu::Parser parser;
  std::vector<double> values;

  Parser(const std::string& text, const std::vector<std::string>& variables)
      : values(std::max<std::size_t>(variables.size(), 1)) {
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      parser.DefineVar(variables[i], &values[i]);
    }
    parser.SetExpr(text);
  }
};

namespace {

std::string at(int position) { return " at character " + std::to_string(position + 1); }

/// muParser lets "t = 3" assign to a variable; a formula must not.
std::optional<std::size_t> assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool compares = i > 0 && std::string("<>!=").find(text[i - 1]) != std::string::npos;
    const bool doubled = i + 1 < text.size() && text[i + 1] == '=';
    if (!compares && !doubled) return i;
  }
  return std::nullopt;
}

/// muParser's own sentence, to be followed by a semicolon: without its full stop and capital.
std::string library_sentence(const mu::Parser::exception_type& error) {
  std::string text = error.GetMsg();
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string sentence(const mu::Parser::exception_type& error, const mu::Parser& parser,
                     const std::string& text) {
  const std::string& token = error.GetToken();
  // At its end muParser counts a character that it has appended.
  const std::string place = at(std::min(error.GetPos(), static_cast<int>(text.size())));
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN: {
      std::vector<std::string> names{"pi"};
      for (const auto& variable : parser.GetVar()) names.push_back(variable.first);
      for (const auto& function : parser.GetFunDef()) names.push_back(function.first);
      const std::string near = did_you_mean(token, names);
      return "unknown name \"" + token + "\"" + place +
             (near.empty() ? "" : " (did you mean \"" + near + "\"?)");
    }
    case mu::ecUNEXPECTED_EOF:
      return "the expression ends too early" + place;
    case mu::ecMISSING_PARENS:
      return "missing \")\"" + place;
    case mu::ecUNEXPECTED_PARENS:
      return "unexpected \"" + token + "\"" + place;
    case mu::ecTOO_MANY_PARAMS:
      return "too many arguments for a function" + place;
    case mu::ecTOO_FEW_PARAMS:
      return "too few arguments for a function" + place;
    case mu::ecEMPTY_EXPRESSION:
      return "the expression is empty";
    default:
      break;
  }
  if (!token.empty()) return "unexpected \"" + token + "\"" + place;
  return library_sentence(error);
}

}  // namespace

std::optional<std::string> Expression::fault(const std::string& text,
                                             const std::vector<std::string>& variables) {
  if (const auto place = assignment(text)) {
    return "is no expression: an assignment \"=\"" + at(static_cast<int>(*place)) +
           "; to compare write ==";
  }
  const QuietFloats quiet;
  std::unique_ptr<Parser> parser;
  try {
    parser = std::make_unique<Parser>(text, variables);
    int results = 0;
    parser->parser.Eval(results);
    if (results != 1) return "is no expression: a comma outside of a function's arguments";
  } catch (const mu::Parser::exception_type& error) {
    if (!parser) return "is no expression: " + library_sentence(error);
    return "is no expression: " + sentence(error, parser->parser, text);
  }
  return std::nullopt;
}

Expression::Expression(std::string text, std::vector<std::string> variables)
    : text_(std::move(text)), variables_(std::move(variables)) {
  if (const auto problem = fault(text_, variables_)) {
    throw UserError("\"" + text_ + "\" " + *problem);
  }
  parser_ = std::make_unique<Parser>(text_, variables_);
}

Expression::Expression(const Expression& other)
    : text_(other.text_),
      variables_(other.variables_),
      parser_(std::make_unique<Parser>(text_, variables_)) {}

Expression& Expression::operator=(const Expression& other) { return *this = Expression(other); }

Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

double Expression::operator()(const double* values) const {
  std::copy(values, values + variables_.size(), parser_->values.begin());
#ifdef SCREE_FP_TRAPS
  const QuietFloats quiet;  // the value may be NaN or infinite; the caller looks at it
#endif
  return parser_->parser.Eval();
}

bool Expression::constant() const { return parser_->parser.GetUsedVar().empty(); }

}  // namespace scree
