// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/report_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "verification/suite/suite.hpp"

namespace scree::verify {
namespace {

constexpr std::size_t columns = 7;
using Row = std::array<std::string, columns>;

/// How near a run is to its limit: above 1 it is beyond, NaN counts as farthest.
double strain(const CheckResult& check, const Judged& run) {
  const double m = run.measured;
  if (std::isnan(m)) return std::numeric_limits<double>::infinity();
  switch (check.expectation.kind) {
    case CheckKind::at_most:
    case CheckKind::at_most_times:
      return m / run.limit;
    case CheckKind::at_least:
    case CheckKind::at_least_times:
      return run.limit / m;
    case CheckKind::within:
      return run.exact ? std::abs(m / *run.exact - 1) / run.limit : 0;
    case CheckKind::within_absolute:
      return run.exact ? std::abs(m - *run.exact) / run.limit : 0;
    case CheckKind::between: {
      const auto& band = check.expectation.limits;
      return std::abs(2 * m - band[0] - band[1]) / (band[1] - band[0]);
    }
    case CheckKind::order:
      return 0;
  }
  return 0;
}

const Judged& worst(const CheckResult& check) {
  if (check.expectation.kind == CheckKind::order) return check.runs.back();
  return *std::max_element(
      check.runs.begin(), check.runs.end(),
      [&](const Judged& a, const Judged& b) { return strain(check, a) < strain(check, b); });
}

/// Text on a screen, cut where the column ends.
std::string cut(const std::string& text, std::size_t width) {
  return text.size() <= width ? text : text.substr(0, width - 2) + "..";
}

Row row_of(const CaseResult& result, const CheckResult& check) {
  const bool one = result.sweep.series.size() == 1 || check.expectation.compared;
  const std::string quantity = check.expectation.quantity + (one ? "" : " [" + check.series + "]");
  return {result.name,
          quantity,
          check.expectation.norm,
          expected_text(check.expectation),
          measured_text(check),
          order_text(check),
          check.passed ? "passed" : "FAILED"};
}

constexpr std::array<std::size_t, columns> widest{26, 44, 40, 34, 24, 6, 7};

std::string line(const Row& row, const std::array<std::size_t, columns>& width) {
  std::string text;
  for (std::size_t c = 0; c < columns; ++c)
    text += fmt::format("{:<{}}", cut(row[c], width[c]), width[c] + 2);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string failures(const CaseResult& result) {
  std::string text;
  for (const RunResult& run : result.runs) {
    if (!run.fault.empty() && !run.plan.may_fail)
      text += fmt::format("{}: {}: {}\n", result.name, run.plan.label, run.fault);
  }
  for (const CheckResult& check : result.checks) {
    if (check.passed) continue;
    // A run's label begins with its series.
    text += fmt::format("{}: {} of {}", result.name, check.expectation.quantity,
                        check.runs.empty() ? check.series : worst(check).run);
    text +=
        fmt::format(": {}, expected {}", measured_text(check), expected_text(check.expectation));
    if (check.order) text += ", order " + order_text(check);
    if (!check.remark.empty()) text += "; " + check.remark;
    text += ". Why: " + check.expectation.why + "\n";
  }
  return text;
}

}  // namespace

std::string number_text(double value) {
  if (value == 0) return "0";
  return fmt::format("{:.4g}", value);
}

std::string measured_text(const CheckResult& check) {
  if (check.runs.empty()) return "nothing";
  const Judged& run = worst(check);
  std::string text = number_text(run.measured);
  if (run.exact) text += " (exact " + number_text(*run.exact) + ")";
  return text;
}

std::string order_text(const CheckResult& check) {
  return check.order ? fmt::format("{:.2f}", *check.order) : "";
}

std::string table_text(const std::vector<CaseResult>& results) {
  std::vector<Row> rows{{"case", "quantity", "norm", "expected", "measured", "order", "verdict"}};
  for (const CaseResult& result : results) {
    for (const CheckResult& check : result.checks) rows.push_back(row_of(result, check));
  }
  std::array<std::size_t, columns> width{};
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < columns; ++c)
      width[c] = std::min(widest[c], std::max(width[c], row[c].size()));
  }
  std::string text, last;
  for (const Row& row : rows) {
    if (!last.empty() && row[0] != last) text += "\n";
    last = row[0];
    text += line(row, width);
  }
  std::string failed;
  for (const CaseResult& result : results) failed += failures(result);
  return text + (failed.empty() ? "" : "\n" + failed);
}

std::string list_text(const std::vector<CaseCode>& cases) {
  std::size_t width = 0;
  for (const CaseCode& code : cases) width = std::max(width, code.name.size());
  std::string text;
  for (const CaseCode& code : cases) {
    const CaseText words = plan_case(code, false).text;
    text += fmt::format("{:<{}}  {}; {}\n", code.name, width, words.physics, words.reference);
  }
  return text;
}

}  // namespace scree::verify
